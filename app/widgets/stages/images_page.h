#pragma once
#include <array>

#include "app/widgets/stages/stage_page.h"

class QLabel;
class QLineEdit;

namespace sinew {

class RadiographPane;

/// The two radiographs and what their files say about them.
class ImagesPage : public StagePage {
  Q_OBJECT
 public:
  explicit ImagesPage(Workspace& workspace);

  void replaceImage(int view, const std::filesystem::path& file);

 protected:
  void refresh() override;

 private:
  struct Side {
    RadiographPane* pane;
    QLabel *kind, *size;
    QLineEdit* declared_mm;
    QWidget* declared_row;
  };
  Side makeSide(int view);
  void declareSpacing(int view);

  std::array<Side, 2> sides_;
};

}  // namespace sinew
