#include "app/render/palette.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

namespace app::render {
namespace {

constexpr float golden = 0.618034f;

float encode(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

bool inside(const glm::vec3& c) { return std::min({c.x, c.y, c.z}) >= 0.0f && std::max({c.x, c.y, c.z}) <= 1.0f; }

/// Converts Björn Ottosson's OKLab to linear sRGB.
glm::vec3 linear_srgb(float lightness, float chroma, float hue) {
  const float angle = hue * 6.2831853f;
  const float a = chroma * std::cos(angle), b = chroma * std::sin(angle);
  const auto cube = [](float v) { return v * v * v; };
  const float l = cube(lightness + 0.3963377774f * a + 0.2158037573f * b);
  const float m = cube(lightness - 0.1055613458f * a - 0.0638541728f * b);
  const float s = cube(lightness - 0.0894841775f * a - 1.2914855480f * b);
  return {4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s,
          -1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s,
          -0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s};
}

template <std::size_t N>
glm::vec3 between(const std::array<glm::vec3, N>& stops, float t) {
  const float at = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(N - 1);
  const auto i = std::min(static_cast<std::size_t>(at), N - 2);
  return glm::mix(stops[i], stops[i + 1], at - static_cast<float>(i));
}

/// Converts OKLCH, with the hue in turns, and reduces the chroma until the colour is in sRGB's gamut. Colours of equal
/// lightness look equally light.
glm::vec3 oklch(float lightness, float chroma, float hue) {
  glm::vec3 linear = linear_srgb(lightness, chroma, hue);
  while (!inside(linear) && chroma > 0.001f) {
    chroma *= 0.96f;
    linear = linear_srgb(lightness, chroma, hue);
  }
  linear = glm::clamp(linear, 0.0f, 1.0f);
  return {encode(linear.x), encode(linear.y), encode(linear.z)};
}

}  // namespace

glm::vec3 body_colour(std::uint32_t number) {
  constexpr std::array<float, 3> lightness{0.70f, 0.58f, 0.80f};
  const float hue = 0.07f + golden * static_cast<float>(number);
  return oklch(lightness[number % 3], 0.145f, hue - std::floor(hue));
}

glm::vec3 bucket_colour(std::uint32_t bucket) {
  // An integer hash, because otherwise buckets that differ by a Fibonacci number would have similar hues.
  std::uint32_t h = bucket * 2654435769u;
  h = (h ^ (h >> 15)) * 2246822519u;
  h ^= h >> 13;
  return oklch(0.52f + 0.16f * static_cast<float>(h >> 24 & 3u) / 3.0f, 0.17f,
               static_cast<float>(h & 0xffffu) / 65536.0f);
}

glm::vec3 sequential_colour(float t) {
  // Viridis (van der Walt and Smith), nine stops.
  static constexpr std::array<glm::vec3, 9> stops{{{0.267f, 0.005f, 0.329f},
                                                   {0.279f, 0.175f, 0.483f},
                                                   {0.230f, 0.322f, 0.546f},
                                                   {0.173f, 0.449f, 0.558f},
                                                   {0.128f, 0.567f, 0.551f},
                                                   {0.158f, 0.684f, 0.502f},
                                                   {0.369f, 0.789f, 0.383f},
                                                   {0.678f, 0.864f, 0.190f},
                                                   {0.993f, 0.906f, 0.144f}}};
  return between(stops, t);
}

glm::vec3 diverging_colour(float t) {
  static constexpr std::array<glm::vec3, 5> stops{{{0.02f, 0.25f, 0.62f},
                                                   {0.26f, 0.58f, 0.80f},
                                                   {0.80f, 0.80f, 0.80f},
                                                   {0.95f, 0.60f, 0.25f},
                                                   {0.75f, 0.25f, 0.00f}}};
  return between(stops, 0.5f + 0.5f * t);
}

}  // namespace app::render
