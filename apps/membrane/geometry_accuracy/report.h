// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "measurement.h"

/// Tables like Table 1, the paper's numbers beside ours, and a verdict on each target.
std::string text_report(const std::vector<Measurement>& measurements);

/// A list of one object per surface, grid and form of Lap H.
std::string json_report(const std::vector<Measurement>& measurements);
