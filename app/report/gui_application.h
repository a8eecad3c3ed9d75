#pragma once

namespace sinew {

/// Text needs a QGuiApplication for its fonts. A program without one gets one of the platform "offscreen", which needs
/// no display; it lives as long as the process. Call it on the main thread.
void haveGuiApplication();

}  // namespace sinew
