#include "softbody/scene/toml_table.h"

#include <cmath>
#include <optional>
#include <sstream>

#include <glm/common.hpp>

#include "softbody/mesh/limits.h"
#include "softbody/scene/scene.h"

namespace softbody {
namespace {

std::string range(double lo, double hi) {
  if (hi == Table::any) return {};
  std::ostringstream s;
  s.precision(10);  // 16777216, not 1.67772e+07
  s << " from " << lo << " to " << hi;
  return s.str();
}

/// Calls parse(). Throws SceneError, which names the file and the line, if it finds no TOML.
toml::table parsed(const std::string& file, const auto& parse) {
  try {
    return parse();
  } catch (const toml::parse_error& e) {
    throw SceneError(file + ":" + std::to_string(e.source().begin.line) + ": " + std::string(e.description()));
  }
}

}  // namespace

toml::table read_toml(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw SceneError(file.string() + ": cannot be read: " + error.message());
  if (size > max_toml_file_size)
    throw SceneError(file.string() + ": is larger than " + std::to_string(max_toml_file_size >> 20) +
                     " MiB; no such file is that long");
  return parsed(file.string(), [&] { return toml::parse_file(file.string()); });
}

toml::table parse_toml(std::string_view text, const std::string& name) {
  return parsed(name, [&] { return toml::parse(text, name); });
}

double Table::number(const std::string& key, double fallback, double lo, double hi) {
  const toml::node* node = find(key);
  if (!node) return fallback;
  const auto value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value) || *value < lo || *value > hi)
    fail(*node, key, "must be a number" + range(lo, hi));
  return *value;
}

int Table::integer(const std::string& key, int fallback, int lo, int hi) {
  const toml::node* node = find(key);
  if (!node) return fallback;
  const auto value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
  if (!value || *value < lo || *value > hi) fail(*node, key, "must be a whole number" + range(lo, hi));
  return static_cast<int>(*value);
}

bool Table::boolean(const std::string& key, bool fallback) {
  const toml::node* node = find(key);
  if (!node) return fallback;
  if (!node->is_boolean()) fail(*node, key, "must be true or false");
  return *node->value<bool>();
}

std::string Table::text(const std::string& key, std::string fallback) {
  const toml::node* node = find(key);
  if (!node) return fallback;
  if (!node->is_string()) fail(*node, key, "must be a string");
  return *node->value<std::string>();
}

glm::dvec3 Table::vector(const std::string& key, glm::dvec3 fallback, double lo, double hi) {
  const toml::node* node = find(key);
  return node ? vector(*node, key, lo, hi) : fallback;
}

glm::dvec3 Table::vector(const toml::node& node, const std::string& key, double lo, double hi) const {
  const toml::array* list = node.as_array();
  if (!list || list->size() != 3) fail(node, key, "must be three numbers, e.g. [0, 1, 0]");
  glm::dvec3 result;
  for (int k = 0; k < 3; ++k) {
    const toml::node& item = (*list)[std::size_t(k)];
    const auto value = item.is_number() ? item.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value) || *value < lo || *value > hi)
      fail(item, key, "must be three numbers, each" + range(lo, hi));
    result[k] = *value;
  }
  return result;
}

glm::dvec3 Table::whole_vector(const std::string& key, glm::dvec3 fallback, double lo, double hi) {
  const glm::dvec3 result = vector(key, fallback, lo, hi);
  if (result != glm::floor(result)) fail(key, "must be three whole numbers");
  return result;
}

glm::dmat3 Table::matrix(const std::string& key) {
  const toml::node* node = find(key);
  const toml::array* list = node ? node->as_array() : nullptr;
  if (!list || list->size() != 3) fail(key, "must be three times three numbers");
  glm::dmat3 columns;
  for (int k = 0; k < 3; ++k) columns[k] = vector((*list)[std::size_t(k)], key, -any, any);
  return columns;
}

std::vector<Index> Table::indices(const std::string& key) {
  const toml::node* node = find(key);
  const toml::array* list = node ? node->as_array() : nullptr;
  if (!list || list->empty()) fail(key, "must be a list of whole numbers, e.g. [0, 8]");
  std::vector<Index> result;
  for (const toml::node& item : *list) {
    const auto value = item.is_integer() ? item.value<std::int64_t>() : std::nullopt;
    if (!value || *value < 0 || *value >= std::int64_t(max_particles))
      fail(item, key, "must be whole numbers from 0 on");
    result.push_back(Index(*value));
  }
  return result;
}

Table Table::child(const std::string& key) {
  static const toml::table empty;
  const toml::node* node = find(key);
  if (!node) return {empty, file_, key};
  if (!node->is_table()) fail(*node, key, "must be a table");
  return {*node->as_table(), file_, key};
}

std::vector<Table> Table::children(const std::string& key) {
  std::vector<Table> list;
  const toml::node* node = find(key);
  if (!node) return list;
  const toml::array* array = node->as_array();
  if (!array) fail(*node, key, "must be a list of tables: write [[" + key + "]]");
  for (const toml::node& item : *array) {
    if (!item.is_table()) fail(item, key, "must be a list of tables: write [[" + key + "]]");
    list.emplace_back(*item.as_table(), file_, key + "[" + std::to_string(list.size()) + "]");
  }
  return list;
}

void Table::close() const {
  for (const auto& [key, node] : table_)
    if (!asked_.contains(std::string(key.str()))) {
      std::string known;
      for (const auto& k : asked_) known.append(known.empty() ? "" : ", ").append(k);
      fail(node, std::string(key.str()), "is not known here; known are: " + known);
    }
}

void Table::fail(const std::string& key, const std::string& what) const {
  const toml::node* node = table_.get(key);
  fail(node ? *node : table_, key, what);
}

const toml::node* Table::find(const std::string& key) {
  asked_.insert(key);
  return table_.get(key);
}

void Table::fail(const toml::node& node, const std::string& key, const std::string& what) const {
  throw SceneError(file_ + ":" + std::to_string(node.source().begin.line) + ": " + (name_.empty() ? "" : name_ + ".") +
                   key + " " + what);
}

}  // namespace softbody
