// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "duct_flow.h"

/// Errors grid by grid, with the orders of their fall from one to the next.
std::string table(const Duct& duct, DuctMethod method, const std::vector<DuctFlow>& flows);

nlohmann::ordered_json to_json(const Duct& duct, DuctMethod method, const std::vector<DuctFlow>& flows);

/// CSV of y, z, u and the series' u at the faces of the section nearest the middle of the duct.
std::string cross_section(const Duct& duct, const DuctFlow& flow);
