#include "app/widgets/controls/colour_bar.h"

#include <QLinearGradient>
#include <QPainter>

#include "app/model/stage_text.h"
#include "app/widgets/controls/theme.h"

namespace sinew {

ColourBar::ColourBar(Ground ground, QWidget* parent) : QWidget{parent}, ground_{ground} {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void ColourBar::setScale(const QString& title, double low, double high, int decimals, bool open_low, bool open_high,
                         std::function<Rgb(double)> colour_of) {
  title_ = title;
  low_ = low, high_ = high;
  decimals_ = decimals;
  open_low_ = open_low, open_high_ = open_high;
  colour_of_ = std::move(colour_of);
  setAccessibleName(tr("%1: %2 to %3").arg(title, figure(low, decimals), figure(high, decimals)));
  update();
}

void ColourBar::setWords(const QString& words) {
  title_ = words;
  colour_of_ = nullptr;
  setAccessibleName(words);
  update();
}

void ColourBar::paintEvent(QPaintEvent*) {
  QPainter painter{this};
  QFont small = font();
  small.setPixelSize(11);
  painter.setFont(small);
  painter.setPen(ground_ == Ground::Dark ? colour::kViewText : colour::kText);
  if (!colour_of_) {
    painter.drawText(rect().adjusted(12, 0, -12, 0), Qt::AlignVCenter | Qt::AlignLeft | Qt::TextWordWrap, title_);
    return;
  }
  const QRectF strip{12, 18, double(width()) - 24, 10};
  painter.drawText(QRectF{12, 2, strip.width(), 14}, Qt::AlignLeft | Qt::AlignVCenter, title_);
  QLinearGradient gradient{strip.topLeft(), strip.topRight()};
  constexpr int kStops = 24;
  for (int i = 0; i <= kStops; ++i) {
    const Rgb c = colour_of_(double(i) / kStops);
    gradient.setColorAt(double(i) / kStops, QColor::fromRgbF(float(c.r), float(c.g), float(c.b)));
  }
  painter.fillRect(strip, gradient);
  constexpr int kLabels = 5;
  for (int i = 0; i < kLabels; ++i) {
    const double t = double(i) / (kLabels - 1), x = strip.left() + t * strip.width();
    QString text = figure(low_ + t * (high_ - low_), decimals_);
    if (i == 0 && open_low_) text.prepend(QChar{0x2264});
    if (i == kLabels - 1 && open_high_) text.prepend(QChar{0x2265});
    const auto side = i == 0 ? Qt::AlignLeft : i == kLabels - 1 ? Qt::AlignRight : Qt::AlignHCenter;
    const double left = i == 0 ? x : i == kLabels - 1 ? x - 60 : x - 30;
    painter.drawLine(QPointF{x, strip.bottom()}, QPointF{x, strip.bottom() + 3});
    painter.drawText(QRectF{left, strip.bottom() + 3, 60, 13}, side | Qt::AlignVCenter, text);
  }
}

}  // namespace sinew
