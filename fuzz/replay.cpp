// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Drives a fuzz target without libFuzzer: every file of its corpus is an input, then so many that are made from these at random, the same
// every time. What breaks a promise ends the program; the last line before says which input did.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

using Bytes = std::vector<std::uint8_t>;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" __attribute__((weak)) int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" __attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                                                     std::size_t largest, unsigned seed);

namespace {
std::minstd_rand random_number(1);
}

/// Writes a few random bytes somewhere or at the end, or cuts the end off.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t largest) {
  const std::size_t start = random_number() % (size + 1);
  if (random_number() % 8 == 0) return start;
  const std::size_t stop = std::min(largest, start + 1 + random_number() % 16);
  std::generate(data + start, data + stop, [] { return static_cast<std::uint8_t>(random_number() >> 8); });
  return std::max(size, stop);
}

namespace {

std::vector<Bytes> read_corpus(const char* folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<Bytes> corpus;
  for (const auto& path : paths) {
    std::ifstream stream(path, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    std::fprintf(stderr, "%s\n", path.c_str());
    LLVMFuzzerTestOneInput(corpus.back().data(), corpus.back().size());
  }
  return corpus;
}

Bytes made_from(Bytes input) {
  const std::size_t largest = input.size() + 128;
  std::size_t size = input.size();
  input.resize(largest);
  for (auto edits = 1 + random_number() % 4; edits > 0; --edits)
    size = LLVMFuzzerCustomMutator == nullptr
               ? LLVMFuzzerMutate(input.data(), size, largest)
               : LLVMFuzzerCustomMutator(input.data(), size, largest, static_cast<unsigned>(random_number()));
  input.resize(size);
  return input;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s CORPUS_FOLDER RANDOM_INPUTS\n", argv[0]);
    return 2;
  }
  const int count = std::atoi(argv[2]);
  if (LLVMFuzzerInitialize != nullptr) LLVMFuzzerInitialize(&argc, &argv);
  const std::vector<Bytes> corpus = read_corpus(argv[1]);
  for (int i = 0; i < count; ++i) {
    const Bytes input = made_from(corpus[random_number() % corpus.size()]);
    std::fprintf(stderr, "random input %d of %d\n", i + 1, count);
    LLVMFuzzerTestOneInput(input.data(), input.size());
  }
  return 0;
}
