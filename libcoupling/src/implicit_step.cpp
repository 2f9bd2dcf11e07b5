#include "implicit_step.h"

#include <fmt/format.h>

#include <stdexcept>

namespace vesiflow::coupling {

ImplicitStep::ImplicitStep(const SimulationParameters& parameters,
                           std::span<const std::unique_ptr<ImmersedVesicle>> vesicles)
    : vesicles_(vesicles) {
  std::size_t size = 0;
  for (const auto& v : vesicles_) {
    motions_.push_back(&dynamic_cast<ImplicitMotion&>(*v->motion));
    size += motions_.back()->unknowns();
  }
  increments_.resize(size);
  fixed_point_ = make_fixed_point(size, {parameters.time.implicit_tolerance, parameters.time.implicit_iterations});
}

void ImplicitStep::take(double dt, const std::function<void(bool again)>& evaluate) {
  const auto for_each_part = [this](auto values, const auto& visit) {
    for (std::size_t i = 0, first = 0; i < motions_.size(); first += motions_[i]->unknowns(), ++i)
      visit(i, values.subspan(first, motions_[i]->unknowns()));
  };
  bool again = false;
  const FixedPoint::Map map = [&](std::span<const double> increments, std::span<double> improved) {
    if (again)
      for_each_part(increments, [this](std::size_t i, auto part) {
        motions_[i]->try_increment(part, vesicles_[i]->membrane);
        vesicles_[i]->is_current = false;
      });
    evaluate(again);
    again = true;
    for_each_part(improved, [this](std::size_t i, auto part) { motions_[i]->get_improved(part); });
  };
  for_each_part(std::span(increments_), [this](std::size_t i, auto part) { motions_[i]->get_trial(part); });
  try {
    fixed_point_->solve(map, increments_);
  } catch (const NoFixedPoint& error) {
    throw std::domain_error(fmt::format(
        "the implicit step was not solved: {} (time.implicit_iterations, time.implicit_tolerance)", error.what()));
  }
  for_each_part(std::span<const double>(increments_), [&](std::size_t i, auto part) {
    motions_[i]->accept(dt, part, vesicles_[i]->membrane);
    vesicles_[i]->is_current = false;
  });
}

}  // namespace vesiflow::coupling
