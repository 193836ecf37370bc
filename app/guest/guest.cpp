#include "app/guest/guest.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

#include "app/base/text.h"
#include "app/base/usage_error.h"
#include "app/guest/guest_process.h"

namespace app::guest {

extern const std::string_view method_header;  // the text of sbcollide/method.h

namespace fs = std::filesystem;
namespace {

struct Language {
  std::string_view ending;
  const char *variable, *compiler, *standard;
};
constexpr std::array languages{Language{".c", "CC", "cc", "-std=c11"}, Language{".cpp", "CXX", "c++", "-std=c++20"}};

const Language* language_of(const fs::path& file) {
  const auto* found = std::ranges::find(languages, file.extension(), &Language::ending);
  return found == languages.end() ? nullptr : found;
}

struct TemporaryFolder {
  fs::path path = fs::temp_directory_path() / ("sbcollide-" + std::to_string(std::random_device{}()));
  TemporaryFolder() {
    fs::create_directory(path);
    fs::permissions(path, fs::perms::owner_all);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
};

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Returns the first line with an error of those that a compiler has printed; else the first one.
std::string first_error(const std::string& printed) {
  std::istringstream lines(printed);
  for (std::string line; std::getline(lines, line);)
    if (const std::size_t at = line.find("error"); at != std::string::npos)
      return line.substr(line.rfind('/', at) + 1);  // without the folder
  return printed.substr(0, printed.find('\n'));
}

/// Compiles a source into folder/guest.so. Returns why that fails, and fills in the errors; else an empty text.
std::string compile(const Language& language, const fs::path& source, const fs::path& folder, const Guest& guest,
                    std::string& errors) {
  fs::create_directory(folder / "sbcollide");
  std::ofstream(folder / "sbcollide/method.h") << method_header;
  const char* chosen = std::getenv(language.variable);
  std::istringstream compiler(chosen && *chosen ? chosen : language.compiler);
  std::vector<std::string> words{std::istream_iterator<std::string>(compiler), {}};
  // No fused multiply-add, so that distances are those of the other methods to the bit. Hidden functions are called as
  // in a program of its own.
  for (const char* word : {language.standard, "-O3", "-march=native", "-g", "-shared", "-fPIC", "-ffp-contract=off",
                           "-fvisibility=hidden"})
    words.emplace_back(word);
  const std::string library = folder / "guest.so";
  words.insert(words.end(), {"-I" + folder.string(), fs::absolute(source).string(), "-o", library, "-lm"});
  std::string printed;
  try {
    Process process(words, -1);
    process.end_input();
    for (int waits = 0; !process.end(); ++waits) {
      if (waits == 12'000 || guest.stopped()) return "compiling took more than a minute";
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    printed = process.errors();
  } catch (const std::system_error&) {  // there is no such program
  }
  if (fs::exists(library)) return {};
  errors = printed;
  if (errors.empty()) return words.front() + ": cannot be started: install a compiler, or set $" + language.variable;
  return "does not compile: " + first_error(errors);
}

}  // namespace

bool is_guest(const fs::path& file) { return language_of(file) || file.extension() == ".so"; }

Guest::Guest(fs::path file) : file_(std::move(file)) {
  if (!is_guest(file_))
    throw UsageError("--guest " + file_.string() + ": must be a source, .c or .cpp, or a library, .so");
}

/// Returns another number when the file has changed; 0: there is none.
std::int64_t Guest::stamp() const {
  std::error_code none;
  const auto time = fs::last_write_time(file_, none);
  return none ? 0 : time.time_since_epoch().count();
}

std::shared_ptr<const Build> Guest::build() const {
  const std::scoped_lock lock(mutex_);
  return build_;
}

void Guest::load() {
  loaded_stamp_ = stamp();
  auto build = std::make_shared<Build>();
  std::unique_lock lock(mutex_, std::defer_lock);
  try {
    const TemporaryFolder folder;
    const Language* language = language_of(file_);
    if (!fs::is_regular_file(file_)) throw std::runtime_error("cannot be read");
    if (language) build->problem = compile(*language, file_, folder.path, *this, build->errors);
    if (build->problem.empty()) {
      const std::string bytes = contents(language ? folder.path / "guest.so" : file_);
      const auto library = std::make_shared<SharedMemory>(bytes.size());
      std::ranges::copy(std::as_bytes(std::span(bytes)), library->bytes().begin());
      const Reply guest = GuestProcess(*this, *library, 0).introduction();
      lock.lock();  // whoever finds the row waits for the build
      build->name = guest.name.data(), build->summary = guest.summary.data();
      if (!method_) add_row(guest.key.data(), *build);
      build->library = library;
    }
  } catch (const std::exception& error) {
    build->problem = failure_text(error);
  }
  if (!build->problem.empty()) build->problem = file_.filename().string() + ": " + build->problem;
  if (!lock.owns_lock()) lock.lock();
  build_ = std::move(build);
}

/// Throws std::runtime_error if the guest cannot have a row.
void Guest::add_row(const std::string& own_key, const Build& build) {
  const std::string& own_name = build.name;
  const auto fits = [](unsigned char c) { return std::isalnum(c) || c == '-'; };
  if (own_key.empty() || own_name.empty() || !std::ranges::all_of(own_key, fits))
    throw std::runtime_error("has the key \"" + own_key + "\" and the name \"" + own_name +
                             "\": both are needed, and a key has only letters, digits and hyphens");
  std::string key = "guest:" + own_key, name = own_name;
  const auto is_taken = [&](const collide::Method& row) { return row.key == key || row.name == name; };
  for (int number = 2; std::ranges::any_of(collide::method_table(), is_taken); ++number) {
    key = "guest:" + own_key + "-" + std::to_string(number);
    name = own_name + " " + std::to_string(number);
  }
  collide::add_method({.key = key,
                       .name = name,
                       .summary = build.summary,
                       .description = description(build),
                       .group = collide::MethodGroup::guests,
                       .exact = false,
                       .make = [self = shared_from_this()] { return make_detector(self); }});
  method_ = collide::find_method(key);
}

std::string Guest::description(const Build& build) const {
  return build.summary + " From " + file_.filename().string() + ".";
}

void Guest::rename() const {
  const auto now = build();
  if (!method_ || now->name.empty()) return;
  auto& own = const_cast<collide::Method&>(*method_);  // what is made while the program runs is no constant
  const auto is_taken = [&](const collide::Method& row) { return &row != &own && row.name == own.name; };
  own.name = now->name;
  for (int number = 2; std::ranges::any_of(collide::method_table(), is_taken); ++number)
    own.name = now->name + " " + std::to_string(number);
  own.summary = now->summary, own.description = description(*now);
}

std::shared_ptr<Guest> open(const fs::path& file) {
  auto guest = std::make_shared<Guest>(file);
  guest->load();
  std::fputs(guest->build()->errors.c_str(), stderr);
  if (const std::string& problem = guest->build()->problem; !problem.empty()) throw UsageError("--guest " + problem);
  return guest;
}

}  // namespace app::guest
