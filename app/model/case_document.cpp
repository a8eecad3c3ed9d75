#include "app/model/case_document.h"

#include "clinical/case/case_io.h"
#include "core/file.h"

namespace sinew {
namespace {

/// Text of the stored case; empty if there is none.
std::string textOf(const std::filesystem::path& folder) {
  std::error_code error;
  if (folder.empty() || !std::filesystem::exists(caseFile(folder), error)) return {};
  return readFile(caseFile(folder));
}

}  // namespace

CaseDocument::CaseDocument(std::filesystem::path resource_dir, QObject* parent)
    : QObject{parent}, resource_dir_{std::move(resource_dir)} {}

void CaseDocument::open(const std::filesystem::path& folder) {
  adopt(loadCase(folder), folder);
}

void CaseDocument::adopt(Case c, const std::filesystem::path& folder) {
  stored_ = c;
  history_ = UndoHistory<Case>{std::move(c)};
  preview_.reset();
  folder_ = folder;
  stored_text_ = textOf(folder_);
  announce();
  emit replaced();
}

void CaseDocument::close() {
  adopt(Case{}, {});
}

bool CaseDocument::wasChangedElsewhere() const {
  return textOf(folder_) != stored_text_;
}

void CaseDocument::save(bool overwrite) {
  require(isOpen(), "no case to save");
  if (!overwrite && wasChangedElsewhere())
    throw InputError{
        {caseFile(folder_).string(), "", "as it was opened", "changed by another program; not overwritten"}};
  saveCase(history_.current(), folder_);
  stored_ = history_.current();
  stored_text_ = textOf(folder_);
  modified_ = false;
  emit saved();
}

bool CaseDocument::edit(const QString& label, const std::function<void(Case&)>& change) {
  const bool had_preview = preview_.has_value();
  preview_.reset();
  Case next = history_.current();
  try {
    change(next);
  } catch (const InputError& error) {
    if (had_preview) emit previewed();
    emit rejected(QString::fromUtf8(error.what()));
    return false;
  }
  if (next == history_.current()) {
    if (had_preview) emit previewed();
    return false;
  }
  history_.commit(label.toStdString(), std::move(next));
  announce();
  return true;
}

void CaseDocument::preview(const std::function<void(Case&)>& change) {
  Case next = history_.current();
  try {
    change(next);
  } catch (const InputError&) {
    return;  // the hand is on its way; only the end of a drag may be refused
  }
  preview_ = std::move(next);
  emit previewed();
}

void CaseDocument::dropPreview() {
  if (!preview_) return;
  preview_.reset();
  emit previewed();
}

void CaseDocument::undo() {
  if (!canUndo()) return;
  preview_.reset();
  history_.undo();
  announce();
}

void CaseDocument::redo() {
  if (!canRedo()) return;
  preview_.reset();
  history_.redo();
  announce();
}

const StageStatus& CaseDocument::statusOf(Stage stage) const {
  if (status_.empty()) status_ = sinew::statusOf(history_.current(), resource_dir_);
  return status_.at(static_cast<std::size_t>(stage));
}

void CaseDocument::announce() {
  status_.clear();
  modified_ = isOpen() && !(history_.current() == stored_);
  emit changed();
}

}  // namespace sinew
