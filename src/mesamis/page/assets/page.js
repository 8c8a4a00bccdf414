// SPDX-License-Identifier: Apache-2.0
// The viewer of the page: three slices of the scan with the outlines of the surfaces, and the surfaces
// in space. Outlines are cut from the triangles anew for each slice. Slices are drawn on plain
// canvases; only the view in space needs WebGL. Lengths are mm, coordinates LPS: left, back, head.
"use strict";

// On paper everything is open.
addEventListener("beforeprint", () => document.querySelectorAll("details").forEach(d => { d.open = true; }));

(() => {
  const by = id => document.getElementById(id);
  const section = by("viewer");
  if (!section || typeof DecompressionStream === "undefined") return;  // the pictures below remain
  const facts = JSON.parse(by("viewer-facts").textContent);

  // ---- data of the page

  const unpacked = async id => {
    const text = atob(by(id).textContent), bytes = new Uint8Array(text.length);
    for (let n = 0; n < text.length; ++n) bytes[n] = text.charCodeAt(n);
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(stream).arrayBuffer();
  };

  /** A NIfTI-1 file of 8-bit samples; its frame is RAS. */
  const readScan = buffer => {
    const view = new DataView(buffer);
    const size = [0, 1, 2].map(a => view.getInt16(42 + 2 * a, true));
    const row = r => [0, 1, 2, 3].map(c => view.getFloat32(280 + 16 * r + 4 * c, true) * (r < 2 ? -1 : 1));
    const rows = [row(0), row(1), row(2)];
    const column = c => rows.map(r => r[c]);
    const spacing = [0, 1, 2].map(c => Math.hypot(...column(c)));
    const direction = [0, 1, 2].map(c => column(c).map(x => x / spacing[c]));  // of each grid axis
    return {size, spacing, direction, origin: column(3), samples: new Uint8Array(buffer, 352)};
  };

  /** MZ3 with triangles, points (RAS) and, maybe, a value at each point. */
  const readSurface = buffer => {
    const view = new DataView(buffer);
    const flags = view.getUint16(2, true), triangles = view.getUint32(4, true), points = view.getUint32(8, true);
    let at = 16;
    const take = (Kind, count) => {
      const array = new Kind(buffer.slice(at, at + 4 * count));
      at += 4 * count;
      return array;
    };
    const corners = take(Int32Array, 3 * triangles), places = take(Float32Array, 3 * points);
    for (let p = 0; p < places.length; p += 3) { places[p] *= -1; places[p + 1] *= -1; }
    return {corners, places, errors: flags & 8 ? take(Float32Array, points) : null};
  };

  // ---- colours

  const kStops = [[43, 131, 186], [171, 221, 164], [255, 255, 191], [253, 174, 97], [215, 25, 28]];
  /** Blue to red for 0 to 1. */
  const errorColour = share => {
    const at = Math.min(Math.max(share, 0), 1) * (kStops.length - 1), n = Math.min(Math.floor(at), kStops.length - 2);
    return kStops[n].map((c, k) => c + (at - n) * (kStops[n + 1][k] - c));
  };
  const css = rgb => `rgb(${rgb.map(Math.round).join(",")})`;

  // ---- geometry

  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const barLength = width => {
    const power = 10 ** Math.floor(Math.log10(width)), digits = width / power;
    return power * (digits >= 5 ? 5 : digits >= 2 ? 2 : 1);
  };
  const kSides = [["L", "R"], ["P", "A"], ["S", "I"]];  // towards larger, towards smaller

  /** The side of the body that a direction leads to; nothing for an oblique one. */
  const sideOf = direction => {
    const axis = [0, 1, 2].find(a => Math.abs(direction[a]) > 0.8);
    return axis === undefined ? "" : kSides[axis][direction[axis] > 0 ? 0 : 1];
  };

  /** Segments of a surface in the plane where grid axis `depth` is `at`: x0 y0 x1 y1 (grid axes `across`, `up`), error. */
  const cut = (surface, depth, across, up, at) => {
    const {corners, grid, errors} = surface, lines = [];
    for (let t = 0; t < corners.length; t += 3) {
      const a = 3 * corners[t], b = 3 * corners[t + 1], c = 3 * corners[t + 2];
      const above = (grid[a + depth] >= at) + (grid[b + depth] >= at) + (grid[c + depth] >= at);
      if (above === 0 || above === 3) continue;
      let error = 0, found = 0;
      for (const [p, q] of [[a, b], [b, c], [c, a]]) {
        if ((grid[p + depth] >= at) === (grid[q + depth] >= at)) continue;
        // From the lower point: both triangles at an edge find the same place.
        const [low, high] = p < q ? [p, q] : [q, p];
        const share = (at - grid[low + depth]) / (grid[high + depth] - grid[low + depth]);
        lines.push(grid[low + across] + share * (grid[high + across] - grid[low + across]),
                   grid[low + up] + share * (grid[high + up] - grid[low + up]));
        if (errors) error += errors[low / 3] + share * (errors[high / 3] - errors[low / 3]);
        ++found;
      }
      if (found === 2) lines.push(error / 2); else lines.length -= 2 * found;
    }
    return lines;
  };

  // ---- state

  const state = {
    at: [0, 0, 0],              // grid coordinates of the cross
    window: facts.window.slice(), zoom: 1, cross: true, outlines: true, errors: false,
    shown: facts.surfaces.map(() => true), azimuth: 25, elevation: 12, zoom3: 1
  };
  let scan, surfaces = [], box, listeners = [];
  const changed = () => listeners.forEach(draw => draw());
  const mostError = () => facts.error_mm || 1;
  const colourOf = (n, error) => state.errors && surfaces[n].errors ? errorColour(error / mostError())
                                                                    : facts.surfaces[n].outline;

  // ---- a slice

  /** Grid axes of a slice as radiologists look at it, by the world axis across it: 0 sagittal, 1 coronal, 2 axial. */
  const planeOf = axis => {
    const used = new Set();
    const nearest = (world) => {
      const free = [0, 1, 2].filter(a => !used.has(a));
      const best = free.reduce((a, b) => Math.abs(scan.direction[b][world]) > Math.abs(scan.direction[a][world]) ? b : a);
      used.add(best);
      return best;
    };
    const [right, down] = [[1, 2], [0, 2], [0, 1]][axis];
    const depth = nearest(axis), across = nearest(right), up = nearest(down);
    const flip = (grid, world, positive) => (scan.direction[grid][world] > 0) === positive ? 1 : -1;
    // The page's x grows to the left of the body or to its back, its y (downwards) to the back or to the feet.
    const signX = flip(across, right, true), signY = flip(up, down, axis === 2);
    const along = (grid, sign) => sideOf(scan.direction[grid].map(x => sign * x));
    return {axis, depth, across, up, signX, signY,
            letters: [along(across, -signX), along(across, signX), along(up, -signY), along(up, signY)]};
  };

  const slicePicture = (plane, index) => {
    const {size, samples} = scan, {depth, across, up} = plane;
    const strides = [1, size[0], size[0] * size[1]];
    const width = size[across], height = size[up];
    const picture = new ImageData(width, height), out = new Uint32Array(picture.data.buffer);
    const {low, step} = facts.scale, [black, white] = state.window;
    const shades = new Uint32Array(256);
    for (let v = 0; v < 256; ++v) {
      const shade = Math.min(255, Math.max(0, Math.round(255 * (low + v * step - black) / Math.max(white - black, step))));
      shades[v] = 0xff000000 | shade << 16 | shade << 8 | shade;
    }
    const first = index * strides[depth];
    for (let y = 0, n = 0; y < height; ++y) {
      const row = first + (plane.signY > 0 ? y : height - 1 - y) * strides[up];
      for (let x = 0; x < width; ++x, ++n) out[n] = shades[samples[row + (plane.signX > 0 ? x : width - 1 - x) * strides[across]]];
    }
    const canvas = document.createElement("canvas");
    canvas.width = width; canvas.height = height;
    canvas.getContext("2d").putImageData(picture, 0, 0);
    return canvas;
  };

  const fitCanvas = canvas => {
    const ratio = Math.min(devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio)), height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
    return ratio;
  };

  const kInk = "#e8edf2", kBack = "#0b0d10";

  /** Sides of the body and a scale bar. @param perMm pixels of the canvas. */
  const drawFrame = (context, ratio, perMm, letters) => {
    const {width, height} = context.canvas, edge = 14 * ratio;
    context.font = `600 ${15 * ratio}px system-ui, sans-serif`;
    context.textAlign = "center"; context.textBaseline = "middle";
    const write = (text, x, y) => {
      context.lineWidth = 3 * ratio; context.strokeStyle = "#000c"; context.strokeText(text, x, y);
      context.fillStyle = kInk; context.fillText(text, x, y);
    };
    const [left, right, top, bottom] = letters;
    write(left, edge, height / 2); write(right, width - edge, height / 2);
    write(top, width / 2, edge); write(bottom, width / 2, height - edge);
    const length = barLength(width / perMm / 4), x = width - 12 * ratio, y = height - 12 * ratio;
    context.lineWidth = 5 * ratio; context.strokeStyle = "#000c";
    for (let pass = 0; pass < 2; ++pass) {
      context.beginPath(); context.moveTo(x - length * perMm, y); context.lineTo(x, y); context.stroke();
      context.lineWidth = 2.5 * ratio; context.strokeStyle = kInk;
    }
    context.font = `${12 * ratio}px system-ui, sans-serif`; context.textAlign = "right";
    write(`${length} mm`, x, y - 12 * ratio);
  };

  const slicePanel = (canvas, axis) => {
    const plane = planeOf(axis), {depth, across, up, signX, signY} = plane;
    const mm = [scan.spacing[across], scan.spacing[up]], count = [scan.size[across], scan.size[up]];
    // Pixels of the slice's picture from the grid: the middle of the first voxel is at 0.5.
    const toX = x => signX > 0 ? x + 0.5 : count[0] - 0.5 - x, toY = y => signY > 0 ? y + 0.5 : count[1] - 0.5 - y;
    let picture = null, key = "", lines = [], scale = 1, left = 0, top = 0;
    const middle = () => [(box.low[across] + box.high[across]) / 2, (box.low[up] + box.high[up]) / 2];
    const pan = [0, 0];
    const draw = () => {
      const ratio = fitCanvas(canvas), context = canvas.getContext("2d"), {width, height} = canvas;
      if (!canvas.clientWidth) return;
      const index = Math.round(state.at[depth]);
      const now = `${index} ${state.window}`;
      if (now !== key) { picture = slicePicture(plane, index); key = now; }
      const [midX, midY] = middle(), margin = 1.25;
      const wide = Math.max(box.high[across] - box.low[across], 8) * mm[0] * margin,
            tall = Math.max(box.high[up] - box.low[up], 8) * mm[1] * margin;
      scale = Math.min(width / wide, height / tall) * state.zoom;  // pixels per mm
      left = width / 2 - toX(midX) * mm[0] * scale + pan[0] * ratio;
      top = height / 2 - toY(midY) * mm[1] * scale + pan[1] * ratio;
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.fillStyle = kBack; context.fillRect(0, 0, width, height);
      context.imageSmoothingEnabled = true; context.imageSmoothingQuality = "high";
      context.drawImage(picture, left, top, count[0] * mm[0] * scale, count[1] * mm[1] * scale);
      const pageX = x => left + toX(x) * mm[0] * scale, pageY = y => top + toY(y) * mm[1] * scale;
      if (state.cross) {
        context.strokeStyle = "#63c7bb99"; context.lineWidth = ratio;
        context.beginPath();
        const x = Math.round(pageX(state.at[across])) + 0.5, y = Math.round(pageY(state.at[up])) + 0.5;
        context.moveTo(x, 0); context.lineTo(x, height); context.moveTo(0, y); context.lineTo(width, y);
        context.stroke();
      }
      if (state.outlines) {
        context.lineWidth = 2.4 * ratio; context.lineCap = context.lineJoin = "round";
        surfaces.forEach((surface, n) => {
          if (!state.shown[n]) return;
          lines = cut(surface, depth, across, up, index);
          const colours = state.errors && surface.errors;
          context.strokeStyle = css(colourOf(n, 0));
          context.beginPath();
          for (let l = 0; l < lines.length; l += 5) {
            if (colours) { context.beginPath(); context.strokeStyle = css(colourOf(n, lines[l + 4])); }
            context.moveTo(pageX(lines[l]), pageY(lines[l + 1]));
            context.lineTo(pageX(lines[l + 2]), pageY(lines[l + 3]));
            if (colours) context.stroke();
          }
          if (!colours) context.stroke();
        });
      }
      drawFrame(context, ratio, scale, plane.letters);
      canvas.dataset.segments = lines.length / 5;
    };
    const step = by_ => moveTo(depth, Math.round(state.at[depth]) + by_);
    const point = event => {
      const ratio = canvas.width / canvas.clientWidth, frame = canvas.getBoundingClientRect();
      const x = ((event.clientX - frame.left) * ratio - left) / scale / mm[0], y = ((event.clientY - frame.top) * ratio - top) / scale / mm[1];
      return [signX > 0 ? x - 0.5 : count[0] - 0.5 - x, signY > 0 ? y - 0.5 : count[1] - 0.5 - y];
    };
    const moveCross = event => {
      const [x, y] = point(event);
      moveTo(across, x, false); moveTo(up, y);
    };
    const move = (x, y) => { pan[0] += x; pan[1] += y; draw(); };
    listen(canvas, {press: (event, held) => held ? undefined : moveCross(event), drag: (event, x, y, held) => held ? move(x, y) : moveCross(event),
                    pinch: (factor, x, y) => { pan[0] += x; pan[1] += y; setZoom(state.zoom * factor); },
                    wheel: (event, turns) => event.ctrlKey ? setZoom(state.zoom * 1.1 ** -turns) : step(signOf(turns)),
                    key: {ArrowUp: () => step(1), ArrowDown: () => step(-1), PageUp: () => step(10), PageDown: () => step(-10),
                          "+": () => setZoom(state.zoom * 1.2), "=": () => setZoom(state.zoom * 1.2), "-": () => setZoom(state.zoom / 1.2),
                          0: () => { pan[0] = pan[1] = 0; setZoom(1); }}});
    return draw;
  };

  const signOf = x => x > 0 ? 1 : -1;
  const setZoom = zoom => { state.zoom = Math.min(Math.max(zoom, 0.1), 40); changed(); };
  const moveTo = (axis, value, draw = true) => {
    state.at[axis] = Math.min(Math.max(value, 0), scan.size[axis] - 1);
    if (draw) changed();
  };

  /** Mouse, touch and keys of a canvas. `held`: with shift or another button. */
  const listen = (canvas, on) => {
    const touches = new Map();
    canvas.addEventListener("pointerdown", event => {
      canvas.setPointerCapture(event.pointerId);
      touches.set(event.pointerId, [event.clientX, event.clientY]);
      if (touches.size === 1 && on.press) on.press(event, event.shiftKey || event.button > 0);
    });
    canvas.addEventListener("pointermove", event => {
      const last = touches.get(event.pointerId);
      if (!last) return;
      const now = [event.clientX, event.clientY], x = now[0] - last[0], y = now[1] - last[1];
      if (touches.size === 2) {
        const other = [...touches].find(([id]) => id !== event.pointerId)[1];
        const distance = p => Math.hypot(p[0] - other[0], p[1] - other[1]);
        on.pinch(distance(now) / Math.max(distance(last), 1), x / 2, y / 2);
      } else {
        on.drag(event, x, y, event.shiftKey || event.buttons > 1);
      }
      touches.set(event.pointerId, now);
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, event => touches.delete(event.pointerId));
    canvas.addEventListener("contextmenu", event => event.preventDefault());
    canvas.addEventListener("wheel", event => {
      // The page scrolls past a viewer that was not touched.
      if (document.activeElement !== canvas && !event.ctrlKey) return;
      event.preventDefault();
      on.wheel(event, event.deltaY / 100 || 0);
    }, {passive: false});
    canvas.addEventListener("keydown", event => {
      const act = on.key[event.key];
      if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      act();
    });
  };

  // ---- the surfaces in space

  const kVertex = `attribute vec3 place, normal, colour; uniform mat3 turn; uniform vec3 middle, scale;
    varying vec3 n, c; void main() { vec3 p = turn * (place - middle); n = turn * normal; c = colour;
    gl_Position = vec4(p.x * scale.x, p.y * scale.y, -p.z * scale.z, 1.0); }`;
  const kFragment = `precision mediump float; varying vec3 n, c; void main() {
    vec3 m = normalize(n); if (!gl_FrontFacing) m = -m; float light = max(dot(m, normalize(vec3(-0.35, 0.5, 1.0))), 0.0);
    gl_FragColor = vec4(c * (0.28 + 0.78 * light), 1.0); }`;

  const program = gl => {
    const made = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, kVertex], [gl.FRAGMENT_SHADER, kFragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source); gl.compileShader(shader); gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    return gl.getProgramParameter(made, gl.LINK_STATUS) ? made : null;
  };

  const normalsOf = ({corners, places}) => {
    const normals = new Float32Array(places.length);
    for (let t = 0; t < corners.length; t += 3) {
      const a = 3 * corners[t], b = 3 * corners[t + 1], c = 3 * corners[t + 2];
      const ux = places[b] - places[a], uy = places[b + 1] - places[a + 1], uz = places[b + 2] - places[a + 2];
      const vx = places[c] - places[a], vy = places[c + 1] - places[a + 1], vz = places[c + 2] - places[a + 2];
      const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
      normals[a] += x; normals[a + 1] += y; normals[a + 2] += z;
      normals[b] += x; normals[b + 1] += y; normals[b + 2] += z;
      normals[c] += x; normals[c + 1] += y; normals[c + 2] += z;
    }
    return normals;
  };

  /** Rows of the camera: right, up, towards the viewer; LPS. Azimuth 0 looks from the front. */
  const camera = () => {
    const a = state.azimuth * Math.PI / 180, e = state.elevation * Math.PI / 180;
    const near = [Math.sin(a) * Math.cos(e), -Math.cos(a) * Math.cos(e), Math.sin(e)];
    const right = [Math.cos(a), Math.sin(a), 0];
    const up = [near[1] * right[2] - near[2] * right[1], near[2] * right[0] - near[0] * right[2], near[0] * right[1] - near[1] * right[0]];
    return [right, up, near];
  };

  const spacePanel = (canvas, overlay) => {
    const gl = canvas.getContext("webgl", {antialias: true, preserveDrawingBuffer: true});
    const made = gl && program(gl);
    if (!made) return null;
    gl.getExtension("OES_element_index_uint");
    const buffer = (kind, data) => {
      const b = gl.createBuffer();
      gl.bindBuffer(kind, b); gl.bufferData(kind, data, gl.STATIC_DRAW);
      return b;
    };
    const parts = surfaces.map(s => ({
      places: buffer(gl.ARRAY_BUFFER, s.places), normals: buffer(gl.ARRAY_BUFFER, normalsOf(s)),
      corners: buffer(gl.ELEMENT_ARRAY_BUFFER, new Uint32Array(s.corners)), count: s.corners.length, colours: null, key: ""
    }));
    const colours = n => {
      const part = parts[n], key = String(state.errors);
      if (part.key === key) return;
      const {places, errors} = surfaces[n], out = new Float32Array(places.length);
      for (let p = 0; p < places.length / 3; ++p) {
        const rgb = state.errors && errors ? errorColour(errors[p] / mostError()) : facts.surfaces[n].rgb;
        for (let k = 0; k < 3; ++k) out[3 * p + k] = rgb[k] / 255;
      }
      part.colours = buffer(gl.ARRAY_BUFFER, out);
      part.key = key;
    };
    const bind = (name, data) => {
      const at = gl.getAttribLocation(made, name);
      gl.bindBuffer(gl.ARRAY_BUFFER, data); gl.enableVertexAttribArray(at); gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 0, 0);
    };
    const reach = box.worldHigh.map((h, k) => (h - box.worldLow[k]) / 2), radius = Math.max(Math.hypot(...reach), 1e-3);
    const middle = box.worldHigh.map((h, k) => (h + box.worldLow[k]) / 2), pan = [0, 0];
    const draw = () => {
      const ratio = fitCanvas(canvas), {width, height} = canvas;
      fitCanvas(overlay);
      const turn = camera(), flat = row => reach.reduce((sum, r, k) => sum + r * Math.abs(turn[row][k]), 0);
      const perMm = 0.86 * Math.min(width / 2 / flat(0), height / 2 / flat(1)) * state.zoom3;
      gl.viewport(0, 0, width, height);
      gl.clearColor(0.043, 0.051, 0.063, 1); gl.enable(gl.DEPTH_TEST);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      gl.useProgram(made);
      const uniform = name => gl.getUniformLocation(made, name);
      const shift = [0, 1, 2].map(k => middle[k] - (pan[0] * turn[0][k] - pan[1] * turn[1][k]) * ratio / perMm);
      gl.uniformMatrix3fv(uniform("turn"), false, [0, 1, 2].flatMap(k => turn.map(row => row[k])));
      gl.uniform3fv(uniform("middle"), shift);
      gl.uniform3f(uniform("scale"), 2 * perMm / width, 2 * perMm / height, 0.25 / radius);
      parts.forEach((part, n) => {
        if (!state.shown[n]) return;
        colours(n);
        bind("place", part.places); bind("normal", part.normals); bind("colour", part.colours);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, part.corners);
        gl.drawElements(gl.TRIANGLES, part.count, gl.UNSIGNED_INT, 0);
      });
      const context = overlay.getContext("2d"), [right, up] = turn, back = v => v.map(x => -x);
      context.clearRect(0, 0, width, height);
      drawFrame(context, ratio, perMm, [sideOf(back(right)), sideOf(right), sideOf(up), sideOf(back(up))]);
    };
    const turnBy = (x, y) => {
      state.azimuth -= x; state.elevation = Math.min(Math.max(state.elevation + y, -90), 90);
      draw();
    };
    const zoom = factor => { state.zoom3 = Math.min(Math.max(state.zoom3 * factor, 0.1), 40); draw(); };
    listen(overlay, {drag: (event, x, y, held) => { if (held) { pan[0] += x; pan[1] += y; draw(); } else turnBy(x / 2, y / 2); },
                     pinch: (factor, x, y) => { pan[0] += x; pan[1] += y; zoom(factor); },
                     wheel: (event, turns) => zoom(1.1 ** -turns),
                     key: {ArrowLeft: () => turnBy(-5, 0), ArrowRight: () => turnBy(5, 0), ArrowUp: () => turnBy(0, 5), ArrowDown: () => turnBy(0, -5),
                           "+": () => zoom(1.2), "=": () => zoom(1.2), "-": () => zoom(1 / 1.2),
                           0: () => { pan[0] = pan[1] = 0; Object.assign(state, {azimuth: 25, elevation: 12}); zoom(1 / state.zoom3); }}});
    return draw;
  };

  // ---- controls

  const position = at => [0, 1, 2].map(k => scan.origin[k] + [0, 1, 2].reduce((sum, a) => sum + at[a] * scan.spacing[a] * scan.direction[a][k], 0));
  const sensible = x => Math.abs(x) >= 100 ? String(Math.round(x)) : String(Number(x.toPrecision(3)));

  const tell = () => {
    const voxel = state.at.map(Math.round), [nx, ny] = scan.size;
    const value = facts.scale.low + facts.scale.step * scan.samples[voxel[0] + nx * (voxel[1] + ny * voxel[2])];
    const places = position(voxel).map((x, k) => `${kSides[k][x >= 0 ? 0 : 1]} ${Math.abs(x).toFixed(0)}`);
    by("readout").textContent = `${sensible(value)} ${facts.unit} at ${places.join(", ")} mm`;
  };

  const slider = (id, low, high, step, get, set) => {
    const input = by(id);
    Object.assign(input, {min: low, max: high, step});
    input.addEventListener("input", () => { set(Number(input.value)); changed(); });
    return () => { input.value = get(); };
  };

  const setUpControls = () => {
    const shows = [];
    [0, 1, 2].forEach(world => {
      const plane = planeOf(world), grid = plane.depth, forward = scan.direction[grid][world] > 0, last = scan.size[grid] - 1;
      const turned = v => forward ? v : last - v;
      shows.push(slider("at-" + "xyz"[world], 0, last, 1, () => turned(Math.round(state.at[grid])), v => { state.at[grid] = turned(v); }));
    });
    const [low, high] = facts.range, step = (high - low) / 500;
    shows.push(slider("window-low", low, high, step, () => state.window[0], v => { state.window = [v, Math.max(state.window[1], v + step)]; }));
    shows.push(slider("window-high", low, high, step, () => state.window[1], v => { state.window = [Math.min(state.window[0], v - step), v]; }));
    const box_ = (input, set) => input && input.addEventListener("change", () => { set(input.checked); changed(); });
    for (const input of section.querySelectorAll("input[data-surface]")) box_(input, on => { state.shown[input.dataset.surface] = on; });
    box_(by("outlines"), on => { state.outlines = on; });
    box_(by("cross"), on => { state.cross = on; });
    box_(by("errors"), on => { state.errors = on; by("error-scale").hidden = !on; });
    if (by("error-most")) by("error-most").textContent = `${Number(mostError().toPrecision(2))} mm`;
    for (const button of section.querySelectorAll("button[data-layout]")) {
      button.addEventListener("click", () => {
        by("panels").dataset.layout = button.dataset.layout;
        for (const b of section.querySelectorAll("button[data-layout]")) b.setAttribute("aria-pressed", String(b === button));
        changed();
      });
    }
    for (const button of section.querySelectorAll("button[data-window]")) {
      button.addEventListener("click", () => { state.window = JSON.parse(button.dataset.window); changed(); });
    }
    listeners.push(() => shows.forEach(show => show()), tell);
  };

  // ---- start

  /** The box of all surfaces, or of the scan: in the grid and in the world. */
  const boxOf = () => {
    const ends = (arrays, count) => {
      const low = [Infinity, Infinity, Infinity], high = low.map(x => -x);
      for (const array of arrays) for (let n = 0; n < array.length; ++n) {
        const k = n % count;
        if (array[n] < low[k]) low[k] = array[n];
        if (array[n] > high[k]) high[k] = array[n];
      }
      return [low, high];
    };
    if (!surfaces.length) return {low: [0, 0, 0], high: scan.size.map(n => n - 1), worldLow: [0, 0, 0], worldHigh: [1, 1, 1]};
    const [low, high] = ends(surfaces.map(s => s.grid), 3), [worldLow, worldHigh] = ends(surfaces.map(s => s.places), 3);
    return {low, high, worldLow, worldHigh};
  };

  const toGrid = places => {
    const grid = new Float32Array(places.length), [x0, y0, z0] = scan.origin;
    for (let a = 0; a < 3; ++a) {
      const [x, y, z] = scan.direction[a], step = scan.spacing[a];
      for (let p = 0; p < places.length; p += 3) {
        grid[p + a] = ((places[p] - x0) * x + (places[p + 1] - y0) * y + (places[p + 2] - z0) * z) / step;
      }
    }
    return grid;
  };

  const start = async () => {
    scan = readScan(await unpacked("scan-copy"));
    for (let n = 0; n < facts.surfaces.length; ++n) {
      const surface = readSurface(await unpacked("surface-" + n));
      surfaces.push({...surface, grid: toGrid(surface.places)});
    }
    box = boxOf();
    const d = facts.at.map((x, k) => x - scan.origin[k]);
    [0, 1, 2].forEach(a => moveTo(a, dot(d, scan.direction[a]) / scan.spacing[a], false));
    section.hidden = false;
    listeners = [[2, "axial"], [1, "coronal"], [0, "sagittal"]].map(([axis, id]) => slicePanel(by(id), axis));
    const space = surfaces.length ? spacePanel(by("space"), by("space-frame")) : null;
    if (space) listeners.push(space); else by("panels").classList.add("flat");
    setUpControls();
    let width = by("panels").clientWidth;
    new ResizeObserver(() => {
      if (by("panels").clientWidth === width) return;  // it calls once at the beginning
      width = by("panels").clientWidth;
      changed();
    }).observe(by("panels"));
    changed();
    section.dataset.ready = "yes";
  };

  start().catch(error => {
    section.hidden = true;
    console.error("viewer: " + error);
  });
})();
