#pragma once
#include <functional>
#include <string>

#include "app/scene/rgb_image.h"

class vtkRenderer;

namespace sinew {

struct OffscreenOptions {
  int supersampling = 2;          ///< rendered this many times larger, then averaged: smooth edges
  bool ambient_occlusion = true;  ///< soft shadows in hollows; costs about as much as the picture itself
};

/// A picture without a window or display: `compose` fills the renderer and sets its camera, then it is drawn.
/// Runs on a thread of its own with an EGL context of its own (so that it never meets a window's OpenGL context) and
/// returns when done; `compose` is called on that thread. Whatever `compose` throws is thrown again here.
/// @throws InputError naming what is missing if this machine has no OpenGL 3.2 through EGL.
RgbImage renderOffscreen(int width_px, int height_px, const std::function<void(vtkRenderer&)>& compose,
                         const OffscreenOptions& options = {});

}  // namespace sinew
