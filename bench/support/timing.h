// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Times of a call, and what is made of many of them: cores may be shared with other programs, so CPU time of the calling
// thread stands beside wall time, and times are compared as ratios of those in the same repetition.
#pragma once

#include <time.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vesiflow::bench {

inline double seconds(clockid_t clock) {
  timespec time;
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Sample {
  double wall = 0.0, cpu = 0.0;  // milliseconds; cpu of this thread only

  Sample& operator+=(const Sample& other) {
    wall += other.wall;
    cpu += other.cpu;
    return *this;
  }
};

template <class Call>
Sample timed(Call&& call) {
  const double wall = seconds(CLOCK_MONOTONIC);
  const double cpu = seconds(CLOCK_THREAD_CPUTIME_ID);
  call();
  return {1e3 * (seconds(CLOCK_MONOTONIC) - wall), 1e3 * (seconds(CLOCK_THREAD_CPUTIME_ID) - cpu)};
}

inline double minimum(const std::vector<Sample>& samples, double Sample::*clock) {
  double least = samples.front().*clock;
  for (const Sample& s : samples) least = std::min(least, s.*clock);
  return least;
}

inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

inline double median(const std::vector<Sample>& samples, double Sample::*clock) {
  std::vector<double> values;
  for (const Sample& s : samples) values.push_back(s.*clock);
  return median(values);
}

// Of the times in the same repetition.
inline double median_ratio(const std::vector<Sample>& above, const std::vector<Sample>& below, double Sample::*clock) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < above.size(); ++i) ratios.push_back(above[i].*clock / (below[i].*clock));
  return median(ratios);
}

}  // namespace vesiflow::bench
