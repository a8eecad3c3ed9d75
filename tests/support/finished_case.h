#pragma once
#include <filesystem>

#include "clinical/case/case.h"
#include "core/model/model.h"

namespace sinew::test {

/// Puts a case into `folder` in which every stage before the report is done and fresh: a drawn body of known shape,
/// its landmarks in two exact cone-beam views, a real fit, a real simulated examination whose right hamstrings are 8
/// % short, plain grey DICOM images. Quick, because no radiograph is rendered.
Case finishedCase(const Model& reference, const std::filesystem::path& folder);

/// A stage's record as the pipeline leaves it.
void markDone(Case& c, Stage stage, const Warnings& warnings = {});

}  // namespace sinew::test
