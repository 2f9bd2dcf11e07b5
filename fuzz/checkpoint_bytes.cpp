// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Checkpoints with damaged bytes. An input is a list of damages to a good checkpoint, so that it stays small and goes on
// meaning something when the format changes: each is a place and what happens there.
#include <fuzzer/FuzzedDataProvider.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "checkpoint_case.h"
#include "input_file.h"
#include "one_thread.h"

namespace vesiflow::fuzz {
namespace {

/// Where the file describes itself, which is a small part of it: near the signatures of HDF5's own structures.
std::vector<std::size_t> descriptions(const std::vector<char>& file) {
  constexpr std::array<std::string_view, 12> signatures{"\x89HDF", "TREE", "HEAP", "SNOD", "GCOL", "OHDR",
                                                        "OCHK",    "BTHD", "FRHP", "FHDB", "FAHD", "FADB"};
  constexpr std::size_t reach = 256;
  const std::string_view text(file.data(), file.size());
  std::vector<bool> near(file.size());
  for (const std::string_view signature : signatures)
    for (std::size_t at = 0; (at = text.find(signature, at)) != std::string_view::npos; ++at)
      std::fill(near.begin() + std::ptrdiff_t(at), near.begin() + std::ptrdiff_t(std::min(at + reach, file.size())),
                true);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < near.size(); ++i)
    if (near[i]) places.push_back(i);
  return places;
}

class Damage {
 public:
  explicit Damage(std::vector<char> intact) : intact_(std::move(intact)), descriptions_(descriptions(intact_)) {}

  std::vector<char> apply(FuzzedDataProvider& choices) const {
    std::vector<char> file = intact_;
    while (choices.remaining_bytes() > 0 && !file.empty()) {
      const std::size_t at = std::min(place(choices), file.size() - 1);
      const auto run = [&] { return std::min<std::size_t>(choices.ConsumeIntegralInRange(1, 64), file.size() - at); };
      const auto here = file.begin() + std::ptrdiff_t(at);
      switch (choices.ConsumeIntegralInRange(0, 5)) {
        case 0:
          file[at] = choices.ConsumeIntegral<char>();
          break;
        case 1:
          file[at] = static_cast<char>(file[at] ^ (1 << choices.ConsumeIntegralInRange(0, 7)));
          break;
        case 2:
          std::fill_n(here, run(), choices.PickValueInArray({'\0', '\xff'}));
          break;
        case 3: {
          const std::size_t count = run(), from = std::min(place(choices), file.size() - count);
          std::copy_n(std::vector<char>(file.begin() + std::ptrdiff_t(from), file.end()).begin(), count, here);
          break;
        }
        case 4: {
          const auto number = choices.PickValueInArray(awkward);
          const std::size_t count = std::min(sizeof number, file.size() - at);
          std::copy_n(reinterpret_cast<const char*>(&number), count, here);
          break;
        }
        default:
          file.resize(at);
      }
    }
    return file;
  }

 private:
  static constexpr std::uint64_t awkward[] = {1,
                                              0x7f,
                                              0xffff,
                                              0x7fffffff,
                                              0xffffffff,
                                              0x100000000,
                                              std::numeric_limits<std::int64_t>::max(),
                                              std::numeric_limits<std::uint64_t>::max(),
                                              0x7ff8000000000000,   // not a number
                                              0x7fefffffffffffff};  // the largest number

  std::size_t place(FuzzedDataProvider& choices) const {
    if (choices.ConsumeBool()) return choices.ConsumeIntegralInRange<std::size_t>(0, intact_.size() - 1);
    return descriptions_[choices.ConsumeIntegralInRange<std::size_t>(0, descriptions_.size() - 1)];
  }

  std::vector<char> intact_;
  std::vector<std::size_t> descriptions_;
};

}  // namespace
}  // namespace vesiflow::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vesiflow::fuzz;
  static const InputFile file("checkpoint.h5");
  static CheckpointCase checkpoint(file.path());
  static const Damage damage(checkpoint.intact());
  FuzzedDataProvider choices(data, size);
  const std::vector<char> damaged = damage.apply(choices);
  file.write({reinterpret_cast<const std::uint8_t*>(damaged.data()), damaged.size()});
  const bool taken = checkpoint.restore(file.path());
  if (size == 0) check(taken, "an intact checkpoint is restored");
  return 0;
}
