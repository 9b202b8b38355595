#include "solidnoise/image/module/image_io.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <string>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

namespace {

namespace algo = OIIO::ImageBufAlgo;

int fail(SolidnoiseImageError* error, const std::string& message) {
  const std::size_t length = std::min(message.size(), error->capacity - 1);
  std::memcpy(error->text, message.data(), length);
  error->text[length] = '\0';
  return 1;
}

OIIO::TypeDesc stored_type(int sample_type) {
  switch (sample_type) {
    case kSolidnoiseImageUint8:
      return OIIO::TypeDesc::UINT8;
    case kSolidnoiseImageUint16:
      return OIIO::TypeDesc::UINT16;
    case kSolidnoiseImageHalf:
      return OIIO::TypeDesc::HALF;
    default:
      return OIIO::TypeDesc::FLOAT;
  }
}

// A file in memory. That of OpenImageIO cannot be read while it is written, as TIFF's writer does.
class MemoryFile final : public OIIO::Filesystem::IOProxy {
 public:
  MemoryFile() : IOProxy("", Write) {}

  const std::string& bytes() const { return bytes_; }

  const char* proxytype() const override { return "memory"; }
  void close() override {}
  std::size_t size() const override { return bytes_.size(); }
  std::size_t read(void* target, std::size_t count) override {
    count = pread(target, count, m_pos);
    m_pos += static_cast<std::int64_t>(count);
    return count;
  }
  std::size_t write(const void* source, std::size_t count) override {
    count = pwrite(source, count, m_pos);
    m_pos += static_cast<std::int64_t>(count);
    return count;
  }
  std::size_t pread(void* target, std::size_t count, std::int64_t offset) override {
    const auto begin = static_cast<std::size_t>(offset);
    if (begin >= bytes_.size()) return 0;
    return bytes_.copy(static_cast<char*>(target), count, begin);
  }
  std::size_t pwrite(const void* source, std::size_t count, std::int64_t offset) override {
    const auto begin = static_cast<std::size_t>(offset);
    if (bytes_.size() < begin + count) bytes_.resize(begin + count);
    std::memcpy(bytes_.data() + begin, source, count);
    return count;
  }

 private:
  std::string bytes_;
};

void set_proxy(OIIO::ImageSpec& spec, OIIO::Filesystem::IOProxy* proxy) {
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
}

int encode(const char* format, const SolidnoiseImagePicture& picture, int sample_type,
           const char* color_space, SolidnoiseImageTake* take, SolidnoiseImageProgress* progress,
           void* context, SolidnoiseImageError* error) {
  MemoryFile file;  // outlives what writes to it, at its end, too
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  if (!output) return fail(error, OIIO::geterror());
  OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, stored_type(sample_type));
  spec.attribute("oiio:ColorSpace", color_space);
  spec.attribute("CompressionQuality", 95);           // JPEG alone uses it
  spec.attribute("DateTime", "1970:01:01 00:00:00");  // else that of writing: files would differ
  spec.attribute("tiff:write_exif", 0);               // which would be written over the rest, in memory
  set_proxy(spec, &file);
  if (!output->open(format, spec)) return fail(error, output->geterror());
  constexpr int kRows = 128;  // between questions whether to go on
  const auto row = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.channels);
  for (int y = 0; y < picture.height; y += kRows) {
    if (progress != nullptr && progress(context, static_cast<float>(y) / static_cast<float>(picture.height)))
      return 0;
    const float* const rows = picture.pixels + row * static_cast<std::size_t>(y);
    const int end = std::min(y + kRows, picture.height);
    if (!output->write_scanlines(y, end, 0, OIIO::TypeDesc::FLOAT, rows))
      return fail(error, output->geterror());
  }
  if (!output->close()) return fail(error, output->geterror());
  take(context, file.bytes().data(), file.bytes().size());
  return 0;
}

int decode(const char* format, const char* bytes, std::size_t count, SolidnoiseImageAllocate* allocate,
           SolidnoiseImageProgress* progress, void* context, SolidnoiseImageError* error) {
  OIIO::Filesystem::IOMemReader proxy(bytes, count);
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
  if (!input) return fail(error, OIIO::geterror());
  OIIO::ImageSpec wishes;
  set_proxy(wishes, &proxy);
  OIIO::ImageSpec spec;
  if (!input->open(format, spec, wishes)) return fail(error, input->geterror());
  float* const pixels = allocate(context, spec.width, spec.height, spec.depth, spec.nchannels);
  if (pixels == nullptr) return fail(error, "no memory for its pixels");
  // Readers hold some tiles whole, whatever part of them the picture has.
  constexpr double kMostTileValues = 1 << 26;
  if (static_cast<double>(spec.tile_width) * spec.tile_height * spec.nchannels > kMostTileValues) {
    return fail(error, "its tiles are " + std::to_string(spec.tile_width) + " x " +
                           std::to_string(spec.tile_height) + " pixels; they must be smaller");
  }
  const bool done =
      input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels, OIIO::AutoStride,
                        OIIO::AutoStride, OIIO::AutoStride, progress, context);
  // The JPEG reader goes on after the end of the file, in grey, and leaves a message.
  if (!done || input->has_error()) return fail(error, input->geterror());
  return 0;
}

// render_text() aborts where no part of a text is in the picture.
bool draw_text(OIIO::ImageBuf& picture, const SolidnoiseImageMark& mark, OIIO::cspan<float> color) {
  const OIIO::ROI extent = algo::text_size(mark.text, mark.size, mark.font);
  if (!extent.defined()) return algo::render_text(picture, 0, 0, mark.text, mark.size, mark.font, color);
  int x = mark.x0;
  if (mark.alignment == kSolidnoiseImageCentre) x -= (extent.xbegin + extent.xend) / 2;
  if (mark.alignment == kSolidnoiseImageRight) x -= extent.xend;
  const OIIO::ROI whole = picture.roi();
  const bool outside = x + extent.xend + mark.outline <= whole.xbegin ||
                       x + extent.xbegin - mark.outline >= whole.xend ||
                       mark.y0 + extent.yend + mark.outline <= whole.ybegin ||
                       mark.y0 + extent.ybegin - mark.outline >= whole.yend;
  return outside || algo::render_text(picture, x, mark.y0, mark.text, mark.size, mark.font, color,
                                      algo::TextAlignX::Left, algo::TextAlignY::Baseline, mark.outline);
}

int draw(float* pixels, int width, int height, const SolidnoiseImageMark& mark, SolidnoiseImageError* error) {
  OIIO::ImageBuf picture(OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::FLOAT), pixels);
  const OIIO::cspan<float> color(mark.color, 3);
  bool done = false;
  switch (mark.kind) {
    case kSolidnoiseImageText:
      done = draw_text(picture, mark, color);
      break;
    case kSolidnoiseImageLine:
      done = algo::render_line(picture, mark.x0, mark.y0, mark.x1, mark.y1, color);
      break;
    default:
      done = algo::render_box(picture, mark.x0, mark.y0, mark.x1, mark.y1, color, true);
  }
  return done ? 0 : fail(error, picture.geterror());
}

}  // namespace

int solidnoise_image_encode(const char* format, const SolidnoiseImagePicture* picture, int sample_type,
                            const char* color_space, SolidnoiseImageTake* take,
                            SolidnoiseImageProgress* progress, void* context, SolidnoiseImageError* error) {
  try {
    return encode(format, *picture, sample_type, color_space, take, progress, context, error);
  } catch (const std::exception& exception) {
    return fail(error, exception.what());
  }
}

int solidnoise_image_decode(const char* format, const char* bytes, size_t count,
                            SolidnoiseImageAllocate* allocate, SolidnoiseImageProgress* progress,
                            void* context, SolidnoiseImageError* error) {
  try {
    return decode(format, bytes, count, allocate, progress, context, error);
  } catch (const std::exception& exception) {
    return fail(error, exception.what());
  }
}

int solidnoise_image_draw(float* pixels, int width, int height, const SolidnoiseImageMark* mark,
                          SolidnoiseImageError* error) {
  try {
    return draw(pixels, width, height, *mark, error);
  } catch (const std::exception& exception) {
    return fail(error, exception.what());
  }
}
