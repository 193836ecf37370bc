#pragma once
// Writes PLY files of any form.

#include <array>
#include <string>
#include <vector>

namespace cli::test {

struct PlyForm {
  std::string format = "ascii", real = "float", length = "uchar", index = "int";
  bool extras = false;       // other properties and another element, to be skipped
  bool faces_first = false;  // the element face stands before the element vertex
};

/// Forms that a reader must tell apart: each format with each type of coordinates, lengths and indices.
std::vector<PlyForm> ply_forms();
std::string text_of(const PlyForm& form);

/// A number as a file of this form has it.
std::string ply_number(const PlyForm& form, const std::string& type, double value);

/// Returns a file.
std::string ply(const std::vector<std::array<float, 3>>& vertices, const std::vector<std::vector<unsigned>>& faces,
                const PlyForm& form = {});

}  // namespace cli::test
