// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/elements.h"

#include <string_view>
#include <utility>

#include "mesamis/report/body_request.h"
#include "mesamis/report/filled_objects.h"

namespace mesamis::detail::run {

ElementResults make_elements(const ElementRequest& asked, const ElementSource& source,
                             const Progress& progress) {
  ElementResults results;
  if (!asked.wanted()) return results;
  const BodyRequest request =
      complete_request(asked.wishes, source.objects,
                       {source.grid, source.tolerance, source.used.blur, asked.memory_gb});
  BodyOptions options = request.elements;
  options.progress = [&](std::string_view, double share) {
    return !progress || progress("elements", share);
  };
  options.skins = asked.skins;
  FilledObjects filled = fill_objects(source.objects, source.grid, options);
  results.skins = std::move(filled.skins);
  for (std::size_t n = 0; n < results.skins.size(); ++n) {
    results.quality.push_back(
        meshing_quality(results.skins[n], source.objects[n].surface, request.elements.tolerance));
  }
  if (!asked.body) return results;
  results.body = make_body_output(std::move(filled.body), source.objects, source.scan, request);
  results.unmet = unmet(*results.body);
  results.loose = loose_parts(results.body->facts.parts, std::ssize(source.objects));
  return results;
}

}  // namespace mesamis::detail::run
