#pragma once
// Reading TOML strictly. Every key is read through Table, which checks type and range and remembers what was asked for,
// so that a key that nobody asked for is reported as unknown.

#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <vector>

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace softbody {

/// The whole file. Throws SceneError if it cannot be read, is larger than max_toml_file_size, or is no TOML.
toml::table read_toml(const std::filesystem::path& file);

inline constexpr std::uintmax_t max_toml_file_size = 16 << 20;  // bytes

/// One table of the file, which must outlive it. All errors are SceneErrors that name the file, the line and the key.
class Table {
 public:
  static constexpr double any = std::numeric_limits<double>::max();

  /// name: of the table in messages; empty for the whole file.
  Table(const toml::table& table, std::string file, std::string name)
      : table_(table), file_(std::move(file)), name_(std::move(name)) {}

  // The value of a key, or the fallback if the key is not there.
  double number(const std::string& key, double fallback, double lo = -any, double hi = any);
  int integer(const std::string& key, int fallback, int lo, int hi);
  bool boolean(const std::string& key, bool fallback);
  std::string text(const std::string& key, std::string fallback);
  glm::dvec3 vector(const std::string& key, glm::dvec3 fallback, double lo = -any, double hi = any);
  glm::dmat3 matrix(const std::string& key);  // its columns; must be there
  glm::dvec3 whole_vector(const std::string& key, glm::dvec3 fallback, double lo, double hi);

  /// Of the file.
  std::filesystem::path folder() const { return std::filesystem::path(file_).parent_path(); }
  bool has(const std::string& key) { return find(key) != nullptr; }
  /// The table below `key`, or an empty one.
  Table child(const std::string& key);
  /// The tables of [[key]].
  std::vector<Table> children(const std::string& key);

  /// Throws if the table holds a key that was never asked for.
  void close() const;
  [[noreturn]] void fail(const std::string& key, const std::string& what) const;

 private:
  const toml::node* find(const std::string& key);
  glm::dvec3 vector(const toml::node& node, const std::string& key, double lo, double hi) const;
  [[noreturn]] void fail(const toml::node& node, const std::string& key, const std::string& what) const;

  const toml::table& table_;
  std::string file_, name_;
  std::set<std::string> asked_;
};

}  // namespace softbody
