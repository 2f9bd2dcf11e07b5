// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

/// \file
/// Parameters of a simulation from and to dictionaries, by the table of libcoupling.
#pragma once

#include <pybind11/pybind11.h>

#include "coupling/simulation_parameters.h"

namespace vesiflow::python {

/// Parameters of a dictionary from full names ("time.step", "vesicles.0.radius") to values.
/// \throws coupling::ParameterError of all names that there are not and values of a wrong type; ranges are checked by the simulation.
coupling::SimulationParameters parameters_of(const pybind11::dict& values);

/// All parameters by their full names, but those that are missing.
pybind11::dict dict_of(const coupling::SimulationParameters& parameters);

}  // namespace vesiflow::python
