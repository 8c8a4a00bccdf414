// SPDX-License-Identifier: Apache-2.0
#include "mesamis/run/outcome.h"

#include <utility>

#include "mesamis/report/label_report.h"
#include "mesamis/run/outcome_details.h"

namespace mesamis {

Outcome::Outcome(OutcomeDetails details)
    : details_(std::make_shared<const OutcomeDetails>(std::move(details))) {}

std::vector<OutcomeObject> Outcome::objects() const {
  const OutcomeDetails& d = *details_;
  std::vector<OutcomeObject> objects;
  for (std::size_t n = 0; n < d.checks.size(); ++n) {
    const bool one = d.one.has_value();
    objects.push_back({one ? d.wanted.front() : d.several->objects[n].segment,
                       one ? d.one->surface : d.several->objects[n].surface, d.checks[n],
                       d.expected_error(n)});
  }
  return objects;
}

std::optional<OutcomeMesh> Outcome::mesh() const {
  const Result* result = details_->mesh();
  if (result == nullptr) return std::nullopt;
  return OutcomeMesh{result->mesh, result->u, result->v, result->f, result->metric};
}

const FiniteElements* Outcome::elements() const {
  const auto& body = details_->elements.body;
  return body ? &body->elements : nullptr;
}

Settings Outcome::settings_used() const {
  const OutcomeDetails& d = *details_;
  return d.one ? settings_of(d.one->parameters)
               : settings_used_by_labels(d.asked, d.several->parameters);
}

std::string Outcome::flaw() const { return details_->verdict.message; }

std::vector<std::string> Outcome::warnings() const {
  std::vector<std::string> lines;
  if (details_->object) lines = details_->object->warnings;
  lines.insert(lines.end(), details_->warnings.begin(), details_->warnings.end());
  return lines;
}

}  // namespace mesamis
