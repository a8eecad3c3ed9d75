#include "app/widgets/controls/curve_plot.h"

#include <QPainter>

#include "app/plot/paint_figure.h"
#include "app/widgets/controls/theme.h"

namespace sinew {

CurvePlot::CurvePlot(QWidget* parent) : QWidget{parent} {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void CurvePlot::setPanel(FigurePanel panel, const QString& x_label) {
  figure_ = {{}, x_label.toStdString(), {std::move(panel)}};
  placeholder_.clear();
  update();
}

void CurvePlot::setNothing(const QString& why) {
  figure_ = {};
  placeholder_ = why;
  update();
}

void CurvePlot::paintEvent(QPaintEvent*) {
  QPainter painter{this};
  if (!figure_.panels.empty()) return paintFigure(painter, rect(), figure_);
  QFont small = font();
  small.setPixelSize(11);
  painter.setFont(small);
  painter.setPen(colour::kMuted);
  painter.drawText(rect().adjusted(16, 16, -16, -16), Qt::AlignCenter | Qt::TextWordWrap, placeholder_);
}

}  // namespace sinew
