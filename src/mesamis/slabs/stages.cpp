// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/stages.h"

#include <algorithm>
#include <mutex>

#include "mesamis/base/parallel.h"
#include "mesamis/base/stopwatch.h"
#include "mesamis/method/passes.h"

namespace mesamis::detail::slabs {
namespace {

std::string done_file(const std::string& name, Index n) {
  return "done." + name + "." + std::to_string(n);
}

}  // namespace

void Stages::run(const std::string& name, Index count, const std::function<SlabWork(Index)>& task) {
  const auto first = [&](int rank) {
    return static_cast<Index>(std::int64_t{count} * rank / team_.size());
  };
  const Index begin = first(team_.rank()), end = first(team_.rank() + 1);
  const Stage stage(progress_, "slabs: " + name);
  const auto mine = static_cast<std::size_t>(end - begin);
  std::mutex one_tells;
  double done = 0;
  parallel_tasks(mine, std::max(1, count / turns_), [&](std::size_t i) {
    const Index n = begin + static_cast<Index>(i);
    if (!scratch_.has(done_file(name, n))) {
      Stopwatch watch;
      SlabWork work = task(n);
      work.seconds = watch.lap();
      ArchiveWriter archive;
      archive.add_one(work);
      scratch_.write(done_file(name, n), archive);
    }
    const std::scoped_lock lock(one_tells);
    stage.advance(++done / static_cast<double>(mine));
  });
  team_.wait_for_all();
}

void Stages::for_slabs(const std::string& name, Index slabs,
                       const std::function<SlabWork(Index)>& task) {
  run(name, slabs, task);
  of_slabs_.push_back(name);
}

void Stages::for_borders(const std::string& name, Index slabs,
                         const std::function<SlabWork(Index)>& task) {
  run(name, slabs - 1, task);
  of_borders_.push_back(name);
}

std::vector<SlabWork> Stages::work_of_slabs(Index slabs) const {
  std::vector<SlabWork> all;
  for (Index s = 0; s < slabs; ++s) {
    SlabWork& sum = all.emplace_back();
    for (const std::string& name : of_slabs_) sum += work_of(name, s);
    if (s + 1 == slabs) continue;
    for (const std::string& name : of_borders_) sum += work_of(name, s);
  }
  return all;
}

SlabWork Stages::work_of(const std::string& name, Index n) const {
  return scratch_.read(done_file(name, n)).next_one<SlabWork>();
}

}  // namespace mesamis::detail::slabs
