#pragma once

namespace sinew {

/// Text needs a QGuiApplication for its fonts. A program without one gets one of the platform "offscreen", which
/// needs no display; it lives as long as the process. Call it on the main thread.
void haveGuiApplication();

/// Qt takes the number format of the user's locale for the whole process when the application is made: with a decimal
/// comma, figures would be printed as "1,5" and DICOM's "0.143" read as 0. Takes it back; call it right after that.
void useDecimalPoints();

}  // namespace sinew
