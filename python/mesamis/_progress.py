# SPDX-License-Identifier: Apache-2.0
"""Progress of long work as a bar."""

import sys


class _Lines:
    """A line on stderr for each stage."""

    def __init__(self):
        self._stage = None

    def show(self, stage, done):
        if stage != self._stage:
            self._stage = stage
            print(f"mesamis: {stage} ({100 * done:.0f} %)", file=sys.stderr, flush=True)

    def close(self):
        pass


class _Bar:
    """A bar of tqdm, in a notebook or on a terminal, with the time left."""

    def __init__(self, tqdm):
        self._bar = tqdm(total=100, bar_format="{desc} {percentage:3.0f} %|{bar}| {elapsed}<{remaining}")

    def show(self, stage, done):
        self._bar.set_description_str(stage, refresh=False)
        self._bar.n = 100 * done
        self._bar.refresh()

    def close(self):
        self._bar.close()


def _display():
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _Lines()
    return _Bar(tqdm)


class Follow:
    """What the library calls while it works: `with Follow(progress, share) as tell: work(tell)`.

    `progress` is a function of stage and fraction, True for a bar, or None. `share` has a method `done`
    of stage and fraction that tells how much of the whole is done; None: the stage is all that is known.
    """

    def __init__(self, progress, share=None):
        self._share = share
        self._display = _display() if progress is True else None
        self._tell = self._show if progress is True else progress or None

    def _show(self, stage, fraction):
        self._display.show(stage, fraction if self._share is None else self._share.done(stage, fraction))

    def __enter__(self):
        return self._tell

    def __exit__(self, kind, *_):
        if self._display is None:
            return
        if kind is None:
            self._display.show("done", 1.0)
        self._display.close()
