#pragma once
#include <array>

#include "app/widgets/stages/stage_page.h"

class QLabel;
class QLineEdit;
class QPushButton;

namespace sinew {

class RadiographPane;

/// The radiographs, two at a time, and what their files say about them.
class ImagesPage : public StagePage {
  Q_OBJECT
 public:
  explicit ImagesPage(Workspace& workspace);

  void replaceImage(int view, const std::filesystem::path& file);
  /// Another exposure, or another part of a stitched pair: it becomes the last view, shown on the right.
  void addImage(const std::filesystem::path& file);
  /// Takes the view on the right out of the case.
  void removeShownView();

 protected:
  void refresh() override;

 private:
  struct Side {
    RadiographPane* pane;
    QLabel *kind, *size;
    QLineEdit* declared_mm;
    QWidget* declared_row;
  };
  Side makeSide(int place);
  void refreshSide(Side& side);
  void declareSpacing(int view, const QString& text);

  std::array<Side, 2> sides_;
  QPushButton* remove_;
};

}  // namespace sinew
