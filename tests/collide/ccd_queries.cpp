#include "ccd_queries.h"

#include <charconv>
#include <fstream>
#include <stdexcept>
#include <string>

namespace collide::test {

namespace {

/// Takes the text up to the next comma.
std::string_view next_field(std::string_view& line) {
  const std::string_view field = line.substr(0, line.find(','));
  line.remove_prefix(std::min(line.size(), field.size() + 1));
  return field;
}

std::optional<KnownQuery> parse(std::string_view line) {
  const std::string_view kind = next_field(line), truth = next_field(line);
  if ((kind != "vf" && kind != "ee") || (truth != "0" && truth != "1")) return std::nullopt;
  KnownQuery query{{kind == "vf" ? Query::Kind::vertex_face : Query::Kind::edge_edge, {}}, truth == "1"};
  for (const auto time : {&oracle::MovingPoint::from, &oracle::MovingPoint::to}) {
    for (oracle::MovingPoint& point : query.points) {
      for (glm::length_t axis = 0; axis < 3; ++axis) {
        const std::string_view x = next_field(line);
        const auto [end, error] = std::from_chars(x.data(), x.data() + x.size(), (point.*time)[axis]);
        if (error != std::errc{} || end != x.data() + x.size()) return std::nullopt;
      }
    }
  }
  if (!line.empty()) return std::nullopt;
  return query;
}

}  // namespace

std::vector<KnownQuery> read_queries(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<KnownQuery> queries;
  for (std::string line; std::getline(in, line);) {
    const std::optional<KnownQuery> query = parse(line);
    if (!query)
      throw std::runtime_error(file.string() + ": line " + std::to_string(queries.size() + 1) + " is no query");
    queries.push_back(*query);
  }
  return queries;
}

}  // namespace collide::test
