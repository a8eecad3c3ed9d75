#pragma once

namespace sinew {

/// Links this library's glewInit() into the program, in front of the system's. Debian's GLEW knows only X displays:
/// on an EGL context it loads every entry point and then reports an error, which VTK prints at each frame.
void acceptEglContexts();

}  // namespace sinew
