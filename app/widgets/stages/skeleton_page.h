#pragma once
#include <array>

#include "app/widgets/stages/stage_page.h"

class QLabel;
class QTableWidget;

namespace sinew {

class ModelView;
class RadiographPane;

/// The fitted skeleton: model, contours over both radiographs, and its figures with their 95 % intervals.
class SkeletonPage : public StagePage {
  Q_OBJECT
 public:
  explicit SkeletonPage(Workspace& workspace);

 protected:
  void refresh() override;

 private:
  void refreshFigures();
  void refreshOverlays(const Model* model);

  ModelView* model_;
  std::array<RadiographPane*, 2> panes_;
  QTableWidget* table_;
  QLabel* summary_;
};

}  // namespace sinew
