#pragma once
#include "clinical/case/case.h"

namespace sinew {

/// Takes a view out of the case: its image, its picks, its image of the phantom and its part of an imported geometry;
/// the views after it move up. @throws InputError for a view that is not there, or if fewer than two would remain.
void removeView(Case& c, int view);

}  // namespace sinew
