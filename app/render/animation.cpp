#include "app/render/animation.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string_view>
#include <utility>

#include "app/base/usage_error.h"

namespace app::render {
namespace {

constexpr std::string_view heading = "RIFF";  // every WebP file begins with it
constexpr float quality = 80;                 // of 100: no blocks show in smooth shades

/// A part of a picture in pixels. `right` and `bottom` lie beyond it.
struct Region {
  int left, top, right, bottom;
  bool empty() const { return left >= right; }
};

/// Returns the region in which two pictures of one size differ, in whole blocks of WebP's compression. So what stays
/// the same inside the region is compressed alike each time, and does not flicker.
Region difference(const engine::Image& a, const engine::Image& b) {
  constexpr int block = 16;
  Region r{a.width, a.height, 0, 0};
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      if (a.at(x, y) != b.at(x, y))
        r = {std::min(r.left, x), std::min(r.top, y), std::max(r.right, x + 1), std::max(r.bottom, y + 1)};
  if (r.empty()) return r;
  const auto round_up = [](int v) { return (v + block - 1) / block * block; };
  return {r.left / block * block, r.top / block * block, std::min(round_up(r.right), a.width),
          std::min(round_up(r.bottom), a.height)};
}

/// Returns a part of a picture as a WebP image; nothing if that fails.
std::string compress(const engine::Image& image, const Region& part) {
  WebPConfig config;
  WebPConfigInit(&config);
  config.quality = quality;
  config.method = 6;  // 0 to 6; the slowest gives the smallest file
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  const std::unique_ptr<WebPMemoryWriter, decltype(&WebPMemoryWriterClear)> written(&writer, &WebPMemoryWriterClear);
  WebPPicture picture;
  WebPPictureInit(&picture);
  const std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> imported(&picture, &WebPPictureFree);
  picture.width = part.right - part.left;
  picture.height = part.bottom - part.top;
  picture.writer = &WebPMemoryWrite;
  picture.custom_ptr = &writer;
  const std::size_t first = static_cast<std::size_t>(part.top * image.width + part.left);
  if (!WebPPictureImportRGBX(&picture, &image.rgba[4 * first], 4 * image.width) || !WebPEncode(&config, &picture))
    return {};
  return {reinterpret_cast<const char*>(writer.mem), writer.size};
}

const std::uint8_t* as_bytes(const std::string& text) { return reinterpret_cast<const std::uint8_t*>(text.data()); }

int milliseconds(double seconds) { return static_cast<int>(std::lround(1000 * seconds)); }

}  // namespace

Animation::Animation(std::filesystem::path file)
    : file_(std::move(file)), out_(file_, heading), mux_(WebPMuxNew(), &WebPMuxDelete) {
  require(mux_ != nullptr);
}

void Animation::add(engine::Image picture, double start) {
  Region part{0, 0, picture.width, picture.height};
  if (!update_.bytes.empty()) {
    assert(picture.width == latest_.width && picture.height == latest_.height && start > update_.start);
    part = difference(latest_, picture);
    if (part.empty()) return;
    finish_update(start);
  }
  update_ = {compress(picture, part), part.left, part.top, start};
  require(!update_.bytes.empty());
  latest_ = std::move(picture);
}

void Animation::write(double end) {
  assert(!update_.bytes.empty() && end > update_.start);
  finish_update(end);
  const WebPMuxAnimParams forever{.bgcolor = 0xffffffff, .loop_count = 0};
  WebPData data;
  WebPDataInit(&data);
  const std::unique_ptr<WebPData, decltype(&WebPDataClear)> assembled(&data, &WebPDataClear);
  require(WebPMuxSetAnimationParams(mux_.get(), &forever) == WEBP_MUX_OK &&
          WebPMuxAssemble(mux_.get(), &data) == WEBP_MUX_OK);
  const std::string_view bytes(reinterpret_cast<const char*>(data.bytes), data.size);
  assert(bytes.starts_with(heading));
  out_.write(bytes.substr(heading.size()));  // the heading is in the file already
  out_.commit();
}

void Animation::finish_update(double end) {
  const WebPMuxFrameInfo frame{.bitstream = {as_bytes(update_.bytes), update_.bytes.size()},
                               .x_offset = update_.left,
                               .y_offset = update_.top,
                               .duration = milliseconds(end) - milliseconds(update_.start),
                               .id = WEBP_CHUNK_ANMF,
                               .dispose_method = WEBP_MUX_DISPOSE_NONE,
                               .blend_method = WEBP_MUX_NO_BLEND,
                               .pad = {}};
  require(WebPMuxPushFrame(mux_.get(), &frame, 1) == WEBP_MUX_OK);
}

void Animation::require(bool done) const {
  if (!done)
    throw UsageError(file_.string() + ": cannot be written: too large; use a smaller --size or fewer --frames");
}

}  // namespace app::render
