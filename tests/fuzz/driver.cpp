// SPDX-License-Identifier: Apache-2.0
// Feeds a fuzz target without libFuzzer: inputs made from consecutive seeds, or files.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Input = std::vector<std::uint8_t>;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Input input_of(std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  Input input(16 + generator() % 240);
  for (std::uint8_t& byte : input) byte = static_cast<std::uint8_t>(generator());
  return input;
}

/// Runs a case. Its bytes lie in a file meanwhile, which stays if the process does not come back.
void run_seed(std::uint64_t seed) {
  const Input input = input_of(seed);
  const std::string path = "fuzz_remesh-" + std::to_string(seed) + ".case";
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(input.data()), std::ssize(input));
  LLVMFuzzerTestOneInput(input.data(), input.size());
  std::remove(path.c_str());
}

void run_seeds(std::uint64_t seed, double seconds) {
  const Clock::time_point start = Clock::now();
  int cases = 0;
  double slowest = 0;
  std::uint64_t slowest_seed = seed;
  for (; seconds_since(start) < seconds; ++seed, ++cases) {
    const Clock::time_point begin = Clock::now();
    run_seed(seed);
    const double taken = seconds_since(begin);
    if (taken <= slowest) continue;
    slowest = taken;
    slowest_seed = seed;
  }
  std::printf("fuzz_remesh: %d cases in %.0f s; the slowest, seed %llu, took %.1f s\n", cases,
              seconds_since(start), static_cast<unsigned long long>(slowest_seed), slowest);
}

int run_file(const char* path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    std::fprintf(stderr, "fuzz_remesh: error: %s: cannot be read\n", path);
    return 1;
  }
  const Input input{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  LLVMFuzzerTestOneInput(input.data(), input.size());
  std::printf("fuzz_remesh: %s passed\n", path);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  double seconds = 10;
  std::uint64_t seed = 1;
  int files = 0, failed = 0;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--seconds" && i + 1 < argc) {
      seconds = std::strtod(argv[++i], nullptr);
    } else if (argument == "--seed" && i + 1 < argc) {
      seed = std::strtoull(argv[++i], nullptr, 10);
    } else if (argument.starts_with("-")) {
      std::fprintf(stderr, "usage: fuzz_remesh [--seconds N] [--seed S] [file...]\n");
      return 2;
    } else {
      failed |= run_file(argv[i]);
      ++files;
    }
  }
  if (files == 0) run_seeds(seed, seconds);
  return failed;
}
