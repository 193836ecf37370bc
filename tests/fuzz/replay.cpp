// Runs a fuzz target without a fuzzer: on every file of a folder, then, the same ones every time, in turn on
// pseudo-random bytes and on a file of the folder in which some bytes have been changed.

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

using Input = std::vector<std::uint8_t>;

void run(const Input& input) { LLVMFuzzerTestOneInput(input.data(), input.size()); }

std::vector<Input> replay(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files{std::filesystem::directory_iterator(folder), {}};
  std::sort(files.begin(), files.end());
  std::vector<Input> inputs;
  for (const std::filesystem::path& file : files) {
    std::fprintf(stderr, "%s\n", file.filename().c_str());  // the last one printed is the one that failed
    std::ifstream in(file, std::ios::binary);
    run(inputs.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()));
  }
  return inputs;
}

Input random_input(std::mt19937& random) {
  Input bytes(16 + random() % 240);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

/// With up to eight changes: a byte of any value, or of one that stands elsewhere, in place of another or before it;
/// some bytes gone, or there twice.
Input changed(Input bytes, std::mt19937& random) {
  for (auto changes = 1 + random() % 8; changes > 0 && !bytes.empty(); --changes) {
    const auto at = std::ptrdiff_t(random() % bytes.size()), end = std::ptrdiff_t(bytes.size());
    const auto count = std::min(std::ptrdiff_t(1 + random() % 16), end - at);
    const std::uint8_t byte = random() % 2 == 0 ? std::uint8_t(random()) : bytes[random() % bytes.size()];
    switch (random() % 4) {
      case 0:
        bytes[std::size_t(at)] = byte;
        break;
      case 1:
        bytes.insert(bytes.begin() + at, byte);
        break;
      case 2:
        bytes.erase(bytes.begin() + at, bytes.begin() + at + count);
        break;
      default: {
        const Input part(bytes.begin() + at, bytes.begin() + at + count);
        bytes.insert(bytes.begin() + std::ptrdiff_t(random() % bytes.size()), part.begin(), part.end());
      }
    }
  }
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint32_t count = 0;
  if (argc != 3 || std::from_chars(argv[2], argv[2] + std::strlen(argv[2]), count).ec != std::errc{}) {
    std::fprintf(stderr, "usage: %s CORPUS_FOLDER NUMBER_OF_OTHER_INPUTS\n", argv[0]);
    return 2;
  }
  const std::vector<Input> files = replay(argv[1]);
  if (files.empty()) return 1;
  for (std::uint32_t seed = 0; seed < count; ++seed) {
    if (seed % 100 == 0) std::fprintf(stderr, "inputs %u to %u\n", seed, seed + 99);
    std::mt19937 random(seed);
    run(seed % 2 == 0 ? random_input(random) : changed(files[random() % files.size()], random));
  }
  std::printf("%zu files and %u other inputs: nothing found\n", files.size(), count);
  return 0;
}
