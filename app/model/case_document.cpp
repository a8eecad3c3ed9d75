#include "app/model/case_document.h"

#include "clinical/case/case_io.h"

namespace sinew {

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
  announce();
  emit replaced();
}

void CaseDocument::close() {
  adopt(Case{}, {});
}

void CaseDocument::save() {
  require(isOpen(), "no case to save");
  saveCase(history_.current(), folder_);
  stored_ = history_.current();
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
