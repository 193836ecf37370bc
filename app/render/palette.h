#pragma once
// The demo's colours, all in sRGB, 0 to 1. No meaning depends on red against green alone.

#include <cstdint>

#include <glm/vec3.hpp>

namespace app::render {

/// Returns the colour of body `number`: hues by the golden ratio in three tiers of lightness, so that dozens differ.
glm::vec3 body_colour(std::uint32_t number);

/// Returns the colour of a bucket of the hash table. Neighbours in the table look different.
glm::vec3 bucket_colour(std::uint32_t bucket);

/// Returns the colour of a load, from few (0, dark violet) to many (1, yellow). The lightness rises all the way.
glm::vec3 sequential_colour(float t);

/// Returns the colour of a strain: shorter than at rest (-1, blue), at rest (0, light grey), longer (1, orange).
glm::vec3 diverging_colour(float t);

// The lights. The name of the colour stands beside each light.
inline constexpr glm::vec3 status_green{0.00f, 0.62f, 0.35f}, status_amber{0.93f, 0.62f, 0.00f},
    status_red{0.82f, 0.13f, 0.12f};

// Okabe and Ito's set, which suits all kinds of colour vision.
inline constexpr glm::vec3 contact_between_colour{0.835f, 0.369f, 0.000f};  // vermilion
inline constexpr glm::vec3 contact_inside_colour{0.000f, 0.000f, 0.000f};   // black: seen on a body of any colour
inline constexpr glm::vec3 contact_solid_colour{0.000f, 0.620f, 0.451f};    // bluish green
inline constexpr glm::vec3 same_cell_colour{0.000f, 0.447f, 0.698f};        // blue: true sharing of a bucket
inline constexpr glm::vec3 aliased_colour{0.902f, 0.624f, 0.000f};          // orange: sharing by the modulo alone
inline constexpr glm::vec3 cell_colour{0.20f, 0.27f, 0.36f};   // dark blue: cells, and what keeps two boxes from one
inline constexpr glm::vec3 area_colour{0.00f, 0.42f, 0.31f};   // areas of the exact method
inline constexpr glm::vec3 hand_colour{0.55f, 0.10f, 0.45f};   // what the mouse holds or selects
inline constexpr glm::vec3 ghost_colour{0.80f, 0.47f, 0.65f};  // reddish purple: the second world
inline constexpr glm::vec3 contact_missed_colour{0.78f, 0.00f, 0.30f};  // crimson
inline constexpr glm::vec3 contact_false_colour = aliased_colour;

}  // namespace app::render
