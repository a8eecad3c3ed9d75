#pragma once
#include <QString>
#include <QWidget>

#include "core/figure.h"

namespace sinew {

/// A panel of a figure in the window (app/plot/paint_figure.h draws it).
class CurvePlot : public QWidget {
  Q_OBJECT
 public:
  explicit CurvePlot(QWidget* parent = nullptr);
  void setPanel(FigurePanel panel, const QString& x_label);
  /// Why there is nothing to show.
  void setNothing(const QString& why);

  QSize sizeHint() const override { return {360, 260}; }
  QSize minimumSizeHint() const override { return {240, 180}; }

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  Figure figure_;
  QString placeholder_;
};

}  // namespace sinew
