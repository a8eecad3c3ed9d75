#pragma once
#include <filesystem>
#include <string>

#include "clinical/case/case.h"

namespace sinew {

/// `folder`/case.json; what it points to, if it is a symbolic link.
std::filesystem::path caseFile(const std::filesystem::path& folder);

/// Reads `folder`/case.json ("sinew.case", version 1). @throws InputError: one line, where, field, expected, found;
/// a version of the future is refused.
Case loadCase(const std::filesystem::path& folder);

/// Writes `folder`/case.json atomically; the previous state stays if that fails.
void saveCase(const Case& c, const std::filesystem::path& folder);

/// The text of case.json: for equality, hashes and saving.
std::string caseToJson(const Case& c);
Case caseFromJson(const std::string& text, const std::string& where);

/// Whether a path of a case points below its folder: relative, no "..", no backslash.
bool staysInFolder(const std::string& relative_path);

/// Copies a file into the case folder (subfolder images, calibration, ...) under a name without patient data
/// ("images/view1.dcm") and returns its reference.
FileReference importFile(const std::filesystem::path& source, const std::filesystem::path& folder,
                         const std::string& relative_path);

/// ".dcm", ".tif" or ".png": what a radiograph is by its content, never by its name, which may hold a person's.
std::string imageExtension(const std::filesystem::path& source);

/// @throws InputError if the file is missing or its content is not what the reference says.
std::filesystem::path checkedFile(const FileReference& reference, const std::filesystem::path& folder);
bool isUndamaged(const FileReference& reference, const std::filesystem::path& folder);

/// Where a result of the case is to be written. @throws InputError if the case folder is gone or a symbolic link
/// leads out of it.
std::filesystem::path resultFile(const std::string& relative_path, const std::filesystem::path& folder);

}  // namespace sinew
