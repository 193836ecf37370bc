// Runs a fuzz target without a fuzzer: on every file of a folder, then on pseudo-random bytes, the same ones every
// time.

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

int replay(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files{std::filesystem::directory_iterator(folder), {}};
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    std::fprintf(stderr, "%s\n", file.filename().c_str());  // the last one printed is the one that failed
    std::ifstream in(file, std::ios::binary);
    const std::vector<char> text{std::istreambuf_iterator<char>(in), {}};
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  }
  return static_cast<int>(files.size());
}

void try_random(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> bytes(16 + random() % 240);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
}

}  // namespace

int main(int argc, char** argv) {
  std::uint32_t count = 0;
  if (argc != 3 || std::from_chars(argv[2], argv[2] + std::strlen(argv[2]), count).ec != std::errc{}) {
    std::fprintf(stderr, "usage: %s CORPUS_FOLDER NUMBER_OF_RANDOM_INPUTS\n", argv[0]);
    return 2;
  }
  const int files = replay(argv[1]);
  for (std::uint32_t seed = 0; seed < count; ++seed) {
    if (seed % 100 == 0) std::fprintf(stderr, "random inputs %u to %u\n", seed, seed + 99);
    try_random(seed);
  }
  std::printf("%d files and %u random inputs: nothing found\n", files, count);
  return files > 0 ? 0 : 1;
}
