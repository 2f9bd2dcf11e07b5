// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/implicit_step.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace vesiflow::coupling {

ImplicitStep::ImplicitStep(std::vector<Member> members, const FixedPoint::Limits& limits)
    : members_(std::move(members)) {
  std::size_t size = 0;
  for (const Member& member : members_) size += member.motion->unknowns();
  increments_.resize(size);
  fixed_point_ = make_fixed_point(size, limits);
}

void ImplicitStep::take(double dt, const std::function<void(bool again)>& evaluate) {
  const auto for_each_part = [this](auto values, const auto& visit) {
    std::size_t first = 0;
    for (const Member& member : members_) {
      visit(member, values.subspan(first, member.motion->unknowns()));
      first += member.motion->unknowns();
    }
  };
  bool again = false;
  const FixedPoint::Map map = [&](std::span<const double> increments, std::span<double> improved) {
    if (again)
      for_each_part(increments, [](const Member& m, auto part) { m.motion->try_increment(part, *m.membrane); });
    evaluate(again);
    again = true;
    for_each_part(improved, [](const Member& m, auto part) { m.motion->get_improved(part); });
  };
  for_each_part(std::span(increments_), [](const Member& m, auto part) { m.motion->get_trial(part); });
  try {
    fixed_point_->solve(map, increments_);
  } catch (const NoFixedPoint& error) {
    throw std::domain_error(fmt::format(
        "the implicit step was not solved: {} (time.implicit_iterations, time.implicit_tolerance)", error.what()));
  }
  for_each_part(std::span<const double>(increments_),
                [dt](const Member& m, auto part) { m.motion->accept(dt, part, *m.membrane); });
}

}  // namespace vesiflow::coupling
