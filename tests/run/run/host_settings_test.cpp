// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What a run finds of the host program's settings, and leaves of them.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <omp.h>
#include <spdlog/sinks/null_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <clocale>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <locale>
#include <regex>
#include <sstream>
#include <string>

#include "files/hdf5_file.h"
#include "run/checkpoint.h"
#include "run/errors.h"
#include "run/plan.h"
#include "run/run.h"
#include "support/small_scene.h"

namespace vesiflow::run::host_settings_test {
namespace {

namespace fs = std::filesystem;

Scene short_scene() {
  return coupling::small_scene({"domain.cells=16", "mesh.latitudes=8", "mesh.tangential_degrees=8", "membrane.g=2",
                                "time.end='2/96'", "output.diagnostics_every='1/96'", "membrane.upsampling=1.5"});
}

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

class HostSettings : public testing::Test {
 protected:
  HostSettings() { fs::remove_all(folder_); }
  ~HostSettings() override { fs::remove_all(folder_); }

  // Its files, in a folder of that name.
  fs::path run_into(const char* name) const {
    SceneSimulation simulation(short_scene());
    run(simulation, {.program = "host", .directory = folder_ / name, .quiet = true});
    return folder_ / name;
  }

  fs::path folder_ = fs::temp_directory_path() / ("vesiflow_host_" + std::to_string(getpid()));
};

herr_t print_of_the_host(hid_t, void*) {
  return 0;
}
herr_t old_print_of_the_host(void*) {
  return 0;
}

TEST_F(HostSettings, Hdf5PrintsAsBefore) {
  H5E_auto2_t before = nullptr, after = nullptr;
  void *data_before = nullptr, *data_after = nullptr;
  H5Eget_auto2(H5E_DEFAULT, &before, &data_before);
  int data = 0;
  H5Eset_auto2(H5E_DEFAULT, print_of_the_host, &data);
  run_into("run");
  EXPECT_THROW(Hdf5File(folder_ / "none.h5", Hdf5File::Mode::read), FileError);
  H5Eget_auto2(H5E_DEFAULT, &after, &data_after);
  EXPECT_EQ(after, print_of_the_host);
  EXPECT_EQ(data_after, &data);
  H5Eset_auto2(H5E_DEFAULT, before, data_before);
}

TEST_F(HostSettings, Hdf5PrintsAsBeforeByItsOldInterface) {
  H5E_auto2_t before = nullptr;
  H5E_auto1_t after = nullptr;
  void *data_before = nullptr, *data_after = nullptr;
  H5Eget_auto2(H5E_DEFAULT, &before, &data_before);
  int data = 0;
  H5Eset_auto1(old_print_of_the_host, &data);
  { const QuietHdf5 quiet; }
  EXPECT_GE(H5Eget_auto1(&after, &data_after), 0);
  EXPECT_EQ(after, old_print_of_the_host);
  EXPECT_EQ(data_after, &data);
  H5Eset_auto2(H5E_DEFAULT, before, data_before);
}

void handler_of_the_host(int) {}

TEST_F(HostSettings, SignalsLoggersAndThreadsAreThoseOfBefore) {
  const auto logger_before = spdlog::default_logger();
  const auto logger = std::make_shared<spdlog::logger>("host", std::make_shared<spdlog::sinks::null_sink_st>());
  spdlog::set_default_logger(logger);
  const auto interrupt = std::signal(SIGINT, handler_of_the_host);
  const auto terminate = std::signal(SIGTERM, handler_of_the_host);
  const int threads = omp_get_max_threads();
  const bool dynamic = omp_get_dynamic() != 0;
  run_into("run");
  EXPECT_EQ(spdlog::default_logger(), logger);
  EXPECT_EQ(omp_get_max_threads(), threads);
  EXPECT_EQ(omp_get_dynamic() != 0, dynamic);
  EXPECT_EQ(std::signal(SIGTERM, terminate), handler_of_the_host);
  EXPECT_EQ(std::signal(SIGINT, interrupt), handler_of_the_host);
  spdlog::set_default_logger(logger_before);
}

// Decimal comma and grouped thousands.
class Continental : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

// For its lifetime the locale of the host, of C++ and, where one is installed, of C.
class ContinentalLocale {
 public:
  ContinentalLocale() : cpp_(std::locale::global(std::locale(std::locale::classic(), new Continental))) {
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "it_IT.UTF-8", "es_ES.UTF-8"})
      if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  ~ContinentalLocale() {
    std::locale::global(cpp_);
    std::setlocale(LC_ALL, c_.c_str());
  }
  ContinentalLocale(const ContinentalLocale&) = delete;
  ContinentalLocale& operator=(const ContinentalLocale&) = delete;

 private:
  std::string c_ = std::setlocale(LC_ALL, nullptr);
  std::locale cpp_;
};

// Its end says what memory and disk are free, which change.
std::string plan_without_the_machine() {
  const std::string plan = describe_plan(short_scene(), 2);
  return std::regex_replace(plan, std::regex("(the machine|the file system of \\.) has [0-9]+"), "$1 has #");
}

TEST_F(HostSettings, ADecimalCommaChangesNoFile) {
  const fs::path here = run_into("here");
  const std::string plan = plan_without_the_machine();
  const ContinentalLocale locale;
  const fs::path there = run_into("there");
  for (const char* file : {"scene.toml", "diagnostics.csv", "vesicle.xdmf", "fluid.xdmf"}) {
    EXPECT_FALSE(text_of(here / file).empty()) << file;
    EXPECT_EQ(text_of(here / file), text_of(there / file)) << file;
  }
  EXPECT_EQ(read_checkpoint_scene(there / "checkpoint.h5").time.step, 1.0 / 96);
  EXPECT_EQ(load_scene(there / "scene.toml").domain.lower[0], -3.0);
  EXPECT_EQ(plan_without_the_machine(), plan);
  // Two runs differ in their times only.
  const auto without_numbers = [](const fs::path& file) {
    return std::regex_replace(text_of(file), std::regex("[-+.0-9e]+"), "#");
  };
  EXPECT_EQ(without_numbers(here / "summary.json"), without_numbers(there / "summary.json"));
}

}  // namespace
}  // namespace vesiflow::run::host_settings_test
