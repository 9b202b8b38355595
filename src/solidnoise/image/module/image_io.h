#pragma once

#include <stddef.h>

// The functions that the module exports, in C so that any build of the library can call any build of the
// module. Each returns 0 if done; if not, it has put a message (ended by a zero) into `error`.

extern "C" {

enum {
  kSolidnoiseImageUint8 = 1,
  kSolidnoiseImageUint16 = 2,
  kSolidnoiseImageHalf = 3,
  kSolidnoiseImageFloat = 4
};

struct SolidnoiseImagePicture {
  int width;
  int height;
  int channels;
  const float* pixels;
};

struct SolidnoiseImageError {
  char* text;
  size_t capacity;
};

// Told the fraction of the picture that is read or written; true to stop: what there is then is not whole.
typedef bool SolidnoiseImageProgress(void* context, float done);

// `format` is OpenImageIO's name of the kind of file, `color_space` "sRGB" or "Linear". Gives the file's
// bytes to `take`, once.
typedef void SolidnoiseImageTake(void* context, const char* bytes, size_t count);
typedef int SolidnoiseImageEncode(const char* format, const SolidnoiseImagePicture* picture, int sample_type,
                                  const char* color_space, SolidnoiseImageTake* take,
                                  SolidnoiseImageProgress* progress, void* context,
                                  SolidnoiseImageError* error);

// Calls `allocate` once, before any pixel is decoded, with what the file's bytes say of its size; it returns
// room for width * height * depth * channels floats, or null.
typedef float* SolidnoiseImageAllocate(void* context, int width, int height, int depth, int channels);
typedef int SolidnoiseImageDecode(const char* format, const char* bytes, size_t count,
                                  SolidnoiseImageAllocate* allocate, SolidnoiseImageProgress* progress,
                                  void* context, SolidnoiseImageError* error);

enum { kSolidnoiseImageText = 1, kSolidnoiseImageLine = 2, kSolidnoiseImageBox = 3 };
enum { kSolidnoiseImageLeft = 0, kSolidnoiseImageCentre = 1, kSolidnoiseImageRight = 2 };

// A line from pixel (x0, y0) to (x1, y1), a filled box with these corners in it, or a text whose base line is
// at (x0, y0).
struct SolidnoiseImageMark {
  int kind;
  int x0;
  int y0;
  int x1;
  int y1;
  float color[3];
  const char* text;  // this and what follows: of a text alone
  const char* font;  // path of a file
  int size;          // of the font, pixels
  int alignment;
  int outline;  // width of a black line around the letters, pixels
};

// Draws on a picture of three channels.
typedef int SolidnoiseImageDraw(float* pixels, int width, int height, const SolidnoiseImageMark* mark,
                                SolidnoiseImageError* error);

SolidnoiseImageEncode solidnoise_image_encode;
SolidnoiseImageDecode solidnoise_image_decode;
SolidnoiseImageDraw solidnoise_image_draw;
}
