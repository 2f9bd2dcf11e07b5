#include "transform_plan.h"

#include <fftw3.h>

#include <algorithm>
#include <mutex>
#include <new>
#include <stdexcept>

#include "message.h"

namespace vesiflow::fluid {
namespace {

// FFTW's planner keeps global state: making and destroying plans must not overlap.
std::mutex planner_mutex;

fftw_r2r_kind kind(Basis basis, Direction direction) {
  const bool forward = direction == Direction::forward;
  switch (basis) {
    case Basis::sine_points:
      return FFTW_RODFT00;
    case Basis::sine_cells:
      return forward ? FFTW_RODFT10 : FFTW_RODFT01;
    case Basis::cosine_cells:
      return forward ? FFTW_REDFT10 : FFTW_REDFT01;
  }
  throw std::invalid_argument("transform: unknown basis");
}

}  // namespace

void AlignedRelease::operator()(double* memory) const {
  fftw_free(memory);
}

AlignedArray allocate_aligned(std::size_t count) {
  double* memory = fftw_alloc_real(count);
  if (memory == nullptr) throw std::bad_alloc();
  std::fill_n(memory, count, 0.0);
  return AlignedArray(memory);
}

struct TransformPlan::Handle {
  fftw_plan plan;
};

TransformPlan::TransformPlan(std::array<int, 2> extent, std::ptrdiff_t row_stride, std::array<Basis, 2> basis,
                             Direction direction)
    : handle_(std::make_unique<Handle>()) {
  const AlignedArray plane = allocate_aligned(static_cast<std::size_t>(row_stride) * extent[1]);
  const std::array<int, 2> size{extent[1], extent[0]};
  const std::array<int, 2> embedding{extent[1], static_cast<int>(row_stride)};
  const std::array<fftw_r2r_kind, 2> kinds{kind(basis[1], direction), kind(basis[0], direction)};
  const std::lock_guard lock(planner_mutex);
  // ESTIMATE and not MEASURE: a measured plan depends on the load of the machine, and with the plan the order
  // of the additions. This way a restart in another process gives the same bits, and so does every thread.
  handle_->plan = fftw_plan_many_r2r(2, size.data(), 1, plane.get(), embedding.data(), 1, 0, plane.get(),
                                     embedding.data(), 1, 0, kinds.data(), FFTW_ESTIMATE);
  if (handle_->plan == nullptr) {
    throw std::runtime_error(message("transform: FFTW made no plan for ", extent[0], " x ", extent[1], " points"));
  }
}

TransformPlan::~TransformPlan() {
  const std::lock_guard lock(planner_mutex);
  fftw_destroy_plan(handle_->plan);
}

void TransformPlan::execute(double* plane) const {
  fftw_execute_r2r(handle_->plan, plane, plane);
}

double TransformPlan::pair_factor(Basis basis, int extent) {
  return basis == Basis::sine_points ? 2.0 * (extent + 1) : 2.0 * extent;
}

}  // namespace vesiflow::fluid
