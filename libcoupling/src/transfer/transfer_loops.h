// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "coupling/marker_transfer.h"
#include "transfer/delta_functions.h"
#include "transfer/shares.h"
#include "transfer/transfer_axis.h"

namespace vesiflow::coupling {

/// The inner loops of MarkerTransfer, for one kernel.
class MarkerTransfer::Loops {
 public:
  /// A marker that cannot be placed; -1 if all can.
  struct Refusal {
    Eigen::Index marker = -1;
    int axis = 0;
  };

  virtual ~Loops() = default;
  virtual Refusal update(const Eigen::Ref<const vesicle::VectorField>& positions) = 0;
  virtual void spread(const vesicle::VectorField& force, const vesicle::ScalarField& area_weight, double per_volume,
                      const std::array<fluid::View, 3>& density) const = 0;
  virtual void interpolate(const std::array<fluid::ConstView, 3>& velocity,
                           vesicle::VectorField& marker_velocity) const = 0;
  /// Of the supports of all markers; empty without any.
  virtual const Box& box() const = 0;
};

template <class Functions>
class MarkerTransfer::KernelLoops final : public MarkerTransfer::Loops {
 public:
  explicit KernelLoops(const std::array<TransferAxis, 3>& axes) : axes_(axes) {
    for (int axis = 0; axis < 3; ++axis)
      if (axes_[axis].periodic) touched_[axis].resize(axes_[axis].cells);
  }

  Refusal update(const Eigen::Ref<const vesicle::VectorField>& positions) override;
  void spread(const vesicle::VectorField& force, const vesicle::ScalarField& area_weight, double per_volume,
              const std::array<fluid::View, 3>& density) const override;
  void interpolate(const std::array<fluid::ConstView, 3>& velocity,
                   vesicle::VectorField& marker_velocity) const override;
  const Box& box() const override { return box_; }

 private:
  using Normal = typename Functions::Normal;          // of faces along an axis: the component of that axis
  using Tangential = typename Functions::Tangential;  // of cell centres along an axis: the two other components

  // Kept small: writing and reading these takes much of the time of all calls.
  struct Stencil {
    std::array<std::int32_t, 3> first_face, first_centre;
    std::array<std::array<double, Normal::width>, 3> at_faces;
    std::array<std::array<double, Tangential::width>, 3> at_centres;
  };
  template <std::size_t width>
  struct Points {
    int first;
    const std::array<double, width>& weights;
  };
  template <int component, int axis>
  static auto points(const Stencil& stencil) {
    if constexpr (axis == component)
      return Points<Normal::width>{stencil.first_face[axis], stencil.at_faces[axis]};
    else
      return Points<Tangential::width>{stencil.first_centre[axis], stencil.at_centres[axis]};
  }

  // The planes z of one thread, counted from the first of the box.
  struct Share {
    int begin, end;
  };

  // Of the points of some markers on the axes that are not periodic, and the first marker that has no place.
  struct Extent {
    Eigen::Index refused = 0;
    std::array<int, 3> first{highest, highest, highest}, last{-1, -1, -1};

    void join(const Extent& other) {
      refused = std::min(refused, other.refused);
      for (int axis = 0; axis < 3; ++axis) {
        first[axis] = std::min(first[axis], other.first[axis]);
        last[axis] = std::max(last[axis], other.last[axis]);
      }
    }

    static constexpr int highest = std::numeric_limits<int>::max();
  };

  [[gnu::always_inline]] void place_marker(const Eigen::Ref<const vesicle::VectorField>& positions, Eigen::Index m,
                                           Extent& extent);
  [[gnu::always_inline]] bool place(double position, int axis, Stencil& stencil, std::uint8_t& wraps) const;
  static IndexRange span_of(const Stencil& stencil, int axis);
  IndexRange touched_range(int axis) const;
  int plane_in_box(int k) const {
    const int plane = k - box_[2].first;
    return plane < 0 ? plane + axes_[2].cells : plane;
  }

  template <int component>
  void spread_component(const Share& share, const double* force, const double* area_weight, double factor,
                        const fluid::View& density) const;
  template <int component>
  void spread_wrapped(const Stencil& stencil, const Share& share, double strength, const fluid::View& density) const;
  template <int component>
  double interpolated(const Stencil& stencil, const fluid::ConstView& velocity) const;
  template <int component>
  double interpolated_wrapped(const Stencil& stencil, const fluid::ConstView& velocity) const;
  template <std::size_t width>
  std::array<int, width> wrapped_points(int axis, int first) const;

  std::array<TransferAxis, 3> axes_;
  std::vector<Stencil> stencils_;
  std::vector<std::uint8_t> wraps_;  // whether a marker's points go from the last of a periodic axis to the first
  Box box_{};
  // Periodic axes: whether some marker's points begin there.
  std::array<std::vector<std::uint8_t>, 3> touched_;
};

// The points of both functions together, before they are wrapped.
template <class Functions>
MarkerTransfer::IndexRange MarkerTransfer::KernelLoops<Functions>::span_of(const Stencil& stencil, int axis) {
  const int faces = stencil.first_face[axis], centres = stencil.first_centre[axis];
  const int first = std::min(faces, centres);
  return {first, std::max(faces + Normal::width, centres + Tangential::width) - first};
}

template <class Functions>
inline bool MarkerTransfer::KernelLoops<Functions>::place(double position, int axis, Stencil& stencil,
                                                          std::uint8_t& wraps) const {
  const TransferAxis& along = axes_[axis];
  const TransferAxis::Place at = along.place(position);
  if (!at.allowed) return false;
  auto faces = stencil_at<Normal>(at.s);
  auto centres = stencil_at<Tangential>(at.s - 0.5);
  if (along.mirrored) {
    fold_faces(faces, at.reflected);
    fold_centres(centres);
  }
  if (along.periodic) {
    faces.first = along.wrapped(faces.first);
    centres.first = along.wrapped(centres.first);
    if (std::max(faces.first + Normal::width, centres.first + Tangential::width) > along.cells) wraps = 1;
  }
  stencil.first_face[axis] = faces.first;
  stencil.first_centre[axis] = centres.first;
  stencil.at_faces[axis] = faces.weights;
  stencil.at_centres[axis] = centres.weights;
  return true;
}

template <class Functions>
inline void MarkerTransfer::KernelLoops<Functions>::place_marker(
    const Eigen::Ref<const vesicle::VectorField>& positions, Eigen::Index m, Extent& extent) {
  Stencil& stencil = stencils_[static_cast<std::size_t>(m)];
  std::uint8_t& wraps = wraps_[static_cast<std::size_t>(m)];
  wraps = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!place(positions(m, axis), axis, stencil, wraps)) {
      extent.refused = std::min(extent.refused, m);
      continue;
    }
    const IndexRange span = span_of(stencil, axis);
    if (axes_[axis].periodic) {
      std::atomic_ref(touched_[axis][static_cast<std::size_t>(stencil.first_face[axis])])
          .store(1, std::memory_order_relaxed);
      continue;
    }
    extent.first[axis] = std::min(extent.first[axis], span.first);
    extent.last[axis] = std::max(extent.last[axis], span.first + span.count - 1);
  }
}

template <class Functions>
MarkerTransfer::Loops::Refusal MarkerTransfer::KernelLoops<Functions>::update(
    const Eigen::Ref<const vesicle::VectorField>& positions) {
  const Eigen::Index count = positions.rows();
  stencils_.resize(static_cast<std::size_t>(count));
  wraps_.resize(stencils_.size());
  for (auto& touched : touched_) std::ranges::fill(touched, std::uint8_t{0});
  Extent all{.refused = count};
  in_shares(count, [&](Eigen::Index begin, Eigen::Index end) {
    Extent share{.refused = count};
    for (Eigen::Index m = begin; m < end; ++m) place_marker(positions, m, share);
#pragma omp critical(vesiflow_extent_of_markers)
    all.join(share);
  });
  if (all.refused < count) {
    Refusal refusal{all.refused, 0};
    while (axes_[refusal.axis].place(positions(all.refused, refusal.axis)).allowed) ++refusal.axis;
    stencils_.clear();  // half of them are not set
    box_ = {};
    return refusal;
  }
  for (int axis = 0; axis < 3; ++axis)
    box_[axis] = count == 0             ? IndexRange{}
                 : axes_[axis].periodic ? touched_range(axis)
                                        : IndexRange{all.first[axis], all.last[axis] - all.first[axis] + 1};
  return {};
}

// On a periodic axis: all but the longest stretch that no support touches.
template <class Functions>
MarkerTransfer::IndexRange MarkerTransfer::KernelLoops<Functions>::touched_range(int axis) const {
  // Centres begin at the first face or, with functions of one width, one point before it.
  constexpr int before = Normal::width == Tangential::width ? 1 : 0, length = Normal::width + before;
  const int cells = axes_[axis].cells;
  const auto& touched = touched_[axis];
  const auto at = [&](int i) { return touched[static_cast<std::size_t>(i)] != 0; };
  int start = 0;
  while (!at(start)) ++start;
  int longest = 0, after_longest = 0;
  for (int step = 1, last = start; step <= cells; ++step) {
    if (!at((start + step) % cells)) continue;
    const int gap = start + step - last - length;
    if (gap > longest) {
      longest = gap;
      after_longest = (start + step) % cells;
    }
    last = start + step;
  }
  if (longest == 0) return {0, cells};
  return {axes_[axis].wrapped(after_longest - before), cells - longest};
}

// Each thread owns a range of planes and goes through all markers in order, so every grid point receives its
// contributions in the same order whatever the number of threads.
template <class Functions>
void MarkerTransfer::KernelLoops<Functions>::spread(const vesicle::VectorField& force,
                                                    const vesicle::ScalarField& area_weight, double per_volume,
                                                    const std::array<fluid::View, 3>& density) const {
  in_shares(box_[2].count, [&](Eigen::Index begin, Eigen::Index end) {
    const Share share{static_cast<int>(begin), static_cast<int>(end)};
    spread_component<0>(share, force.col(0).data(), area_weight.data(), per_volume, density[0]);
    spread_component<1>(share, force.col(1).data(), area_weight.data(), per_volume, density[1]);
    spread_component<2>(share, force.col(2).data(), area_weight.data(), per_volume, density[2]);
  });
}

template <class Functions>
template <int component>
void MarkerTransfer::KernelLoops<Functions>::spread_component(const Share& share, const double* force,
                                                              const double* area_weight, double factor,
                                                              const fluid::View& density) const {
  for (std::size_t m = 0; m < stencils_.size(); ++m) {
    const Stencil& stencil = stencils_[m];
    const double strength = force[m] * area_weight[m] * factor;
    if (wraps_[m] != 0) {
      spread_wrapped<component>(stencil, share, strength, density);
      continue;
    }
    const auto x = points<component, 0>(stencil);
    const auto y = points<component, 1>(stencil);
    const auto z = points<component, 2>(stencil);
    const int z0 = plane_in_box(z.first);
    const int k_begin = std::max(0, share.begin - z0);
    const int k_end = std::min(static_cast<int>(z.weights.size()), share.end - z0);
    const auto weights_x =
        x.weights;  // a copy cannot change with the density: the row below becomes vector instructions
    for (int k = k_begin; k < k_end; ++k) {
      double* corner = density.row(y.first, z.first + k) + x.first;
      for (std::size_t j = 0; j < y.weights.size(); ++j) {
        const double w = strength * z.weights[k] * y.weights[j];
        double* row = corner + static_cast<std::ptrdiff_t>(j) * density.row_stride;
        for (std::size_t i = 0; i < weights_x.size(); ++i) row[i] += w * weights_x[i];
      }
    }
  }
}

template <class Functions>
template <std::size_t width>
std::array<int, width> MarkerTransfer::KernelLoops<Functions>::wrapped_points(int axis, int first) const {
  std::array<int, width> indices;
  for (std::size_t i = 0; i < width; ++i) {
    const int index = first + static_cast<int>(i);
    indices[i] = axes_[axis].periodic ? axes_[axis].wrapped(index) : index;
  }
  return indices;
}

template <class Functions>
template <int component>
void MarkerTransfer::KernelLoops<Functions>::spread_wrapped(const Stencil& stencil, const Share& share, double strength,
                                                            const fluid::View& density) const {
  const auto [x0, x] = points<component, 0>(stencil);
  const auto [y0, y] = points<component, 1>(stencil);
  const auto [z0, z] = points<component, 2>(stencil);
  const auto ix = wrapped_points<std::tuple_size_v<std::decay_t<decltype(x)>>>(0, x0);
  const auto iy = wrapped_points<std::tuple_size_v<std::decay_t<decltype(y)>>>(1, y0);
  const auto iz = wrapped_points<std::tuple_size_v<std::decay_t<decltype(z)>>>(2, z0);
  for (std::size_t k = 0; k < z.size(); ++k) {
    const int plane = plane_in_box(iz[k]);
    if (plane < share.begin || plane >= share.end) continue;
    for (std::size_t j = 0; j < y.size(); ++j) {
      const double w = strength * z[k] * y[j];
      double* row = density.row(iy[j], iz[k]);
      for (std::size_t i = 0; i < x.size(); ++i) row[ix[i]] += w * x[i];
    }
  }
}

template <class Functions>
void MarkerTransfer::KernelLoops<Functions>::interpolate(const std::array<fluid::ConstView, 3>& velocity,
                                                         vesicle::VectorField& marker_velocity) const {
  in_shares(static_cast<Eigen::Index>(stencils_.size()), [&](Eigen::Index begin, Eigen::Index end) {
    for (Eigen::Index m = begin; m < end; ++m) {
      const Stencil& stencil = stencils_[static_cast<std::size_t>(m)];
      if (wraps_[static_cast<std::size_t>(m)] != 0) {
        marker_velocity(m, 0) = interpolated_wrapped<0>(stencil, velocity[0]);
        marker_velocity(m, 1) = interpolated_wrapped<1>(stencil, velocity[1]);
        marker_velocity(m, 2) = interpolated_wrapped<2>(stencil, velocity[2]);
      } else {
        marker_velocity(m, 0) = interpolated<0>(stencil, velocity[0]);
        marker_velocity(m, 1) = interpolated<1>(stencil, velocity[1]);
        marker_velocity(m, 2) = interpolated<2>(stencil, velocity[2]);
      }
    }
  });
}

template <class Functions>
template <int component>
double MarkerTransfer::KernelLoops<Functions>::interpolated(const Stencil& stencil,
                                                            const fluid::ConstView& velocity) const {
  const auto x = points<component, 0>(stencil);
  const auto y = points<component, 1>(stencil);
  const auto z = points<component, 2>(stencil);
  std::array<double, std::tuple_size_v<std::decay_t<decltype(x.weights)>>> along_x{};
  for (std::size_t k = 0; k < z.weights.size(); ++k) {
    const double* corner = velocity.row(y.first, z.first + static_cast<int>(k)) + x.first;
    for (std::size_t j = 0; j < y.weights.size(); ++j) {
      const double w = z.weights[k] * y.weights[j];
      const double* row = corner + static_cast<std::ptrdiff_t>(j) * velocity.row_stride;
      for (std::size_t i = 0; i < along_x.size(); ++i) along_x[i] += w * row[i];
    }
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < along_x.size(); ++i) sum += along_x[i] * x.weights[i];
  return sum;
}

template <class Functions>
template <int component>
double MarkerTransfer::KernelLoops<Functions>::interpolated_wrapped(const Stencil& stencil,
                                                                    const fluid::ConstView& velocity) const {
  const auto [x0, x] = points<component, 0>(stencil);
  const auto [y0, y] = points<component, 1>(stencil);
  const auto [z0, z] = points<component, 2>(stencil);
  const auto ix = wrapped_points<std::tuple_size_v<std::decay_t<decltype(x)>>>(0, x0);
  const auto iy = wrapped_points<std::tuple_size_v<std::decay_t<decltype(y)>>>(1, y0);
  const auto iz = wrapped_points<std::tuple_size_v<std::decay_t<decltype(z)>>>(2, z0);
  std::array<double, std::tuple_size_v<std::decay_t<decltype(x)>>> along_x{};
  for (std::size_t k = 0; k < z.size(); ++k)
    for (std::size_t j = 0; j < y.size(); ++j) {
      const double w = z[k] * y[j];
      const double* row = velocity.row(iy[j], iz[k]);
      for (std::size_t i = 0; i < x.size(); ++i) along_x[i] += w * row[ix[i]];
    }
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += along_x[i] * x[i];
  return sum;
}

}  // namespace vesiflow::coupling
