#pragma once
// The demo's colours, all sRGB 0 .. 1. Meanings never rest on red against green alone.

#include <cstdint>

#include <glm/vec3.hpp>

namespace app {

/// Lightness and chroma of OKLCH with a hue in turns, brought into sRGB's gamut. Equal lightness looks equally light.
glm::vec3 oklch(float lightness, float chroma, float hue);

/// The colour of a body of this number: hues by the golden ratio in three tiers of lightness, so that dozens differ.
glm::vec3 body_colour(std::uint32_t number);

/// The colour of a bucket of the hash table: neighbours in the table look unlike.
glm::vec3 bucket_colour(std::uint32_t bucket);

/// Load of a bucket or the like, from few (0) to many (1): dark violet to yellow, lightness rising all the way.
glm::vec3 sequential_colour(float t);

/// Strain: shorter than at rest (-1, blue), as at rest (0, light grey), longer (1, orange).
glm::vec3 diverging_colour(float t);

// Lights, whose colours are named beside them.
inline constexpr glm::vec3 status_green{0.00f, 0.62f, 0.35f}, status_amber{0.93f, 0.62f, 0.00f},
    status_red{0.82f, 0.13f, 0.12f};

// Okabe and Ito's set, made for all kinds of colour vision.
inline constexpr glm::vec3 contact_between_colour{0.835f, 0.369f, 0.000f};  // vermilion
inline constexpr glm::vec3 contact_inside_colour{0.000f, 0.447f, 0.698f};   // blue
inline constexpr glm::vec3 contact_solid_colour{0.000f, 0.620f, 0.451f};    // bluish green
inline constexpr glm::vec3 same_cell_colour{0.000f, 0.447f, 0.698f};        // blue: true sharing of a bucket
inline constexpr glm::vec3 aliased_colour{0.902f, 0.624f, 0.000f};          // orange: sharing by the modulo alone
inline constexpr glm::vec3 cell_colour{0.20f, 0.27f, 0.36f};                // occupied cells: dark blue
inline constexpr glm::vec3 area_colour{0.00f, 0.42f, 0.31f};                // the exact method's, darker
inline constexpr glm::vec3 hand_colour{0.55f, 0.10f, 0.45f};                // what the mouse holds and selects
inline constexpr glm::vec3 ghost_colour{0.80f, 0.47f, 0.65f};               // reddish purple: the second world
inline constexpr glm::vec3 contact_missed_colour{0.10f, 0.05f, 0.10f};      // nearly black

}  // namespace app
