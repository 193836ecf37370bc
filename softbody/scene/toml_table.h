#pragma once
// Reads TOML strictly. Every key is read through Table, which checks type and range and records which keys were read,
// so that all other keys are reported as unknown.

#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "softbody/mesh/mesh.h"

namespace softbody {

/// Reads a whole file. Throws SceneError if it cannot be read, is larger than max_toml_file_size, or is no TOML.
toml::table read_toml(const std::filesystem::path& file);
/// Reads the text of a file, which messages call `name`. Throws SceneError if it is no TOML.
toml::table parse_toml(std::string_view text, const std::string& name);

inline constexpr std::uintmax_t max_toml_file_size = 16 << 20;  // bytes

/// One table of a file. The parsed file must outlive it. All errors are SceneErrors that name the file, line and key.
class Table {
 public:
  static constexpr double any = std::numeric_limits<double>::max();

  /// name: the table's name in messages; empty for the whole file.
  Table(const toml::table& table, std::string file, std::string name)
      : table_(table), file_(std::move(file)), name_(std::move(name)) {}

  // Return the value of a key, or the fallback if the key is missing.
  double number(const std::string& key, double fallback, double lo, double hi);
  int integer(const std::string& key, int fallback, int lo, int hi);
  bool boolean(const std::string& key, bool fallback);
  std::string text(const std::string& key, std::string fallback);
  glm::dvec3 vector(const std::string& key, glm::dvec3 fallback, double lo, double hi);
  glm::dmat3 matrix(const std::string& key);           // written by columns; the key must exist
  std::vector<Index> indices(const std::string& key);  // at least one
  glm::dvec3 whole_vector(const std::string& key, glm::dvec3 fallback, double lo, double hi);

  /// Returns the folder of the file.
  std::filesystem::path folder() const { return std::filesystem::path(file_).parent_path(); }
  bool has(const std::string& key) { return find(key) != nullptr; }
  /// Returns the table at `key`, or an empty one.
  Table child(const std::string& key);
  /// Returns the tables of [[key]].
  std::vector<Table> children(const std::string& key);

  /// Throws SceneError if the table has a key that was not read.
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
