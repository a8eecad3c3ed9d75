#include "app/widgets/controls/theme.h"

#include <QApplication>
#include <QDir>
#include <QFile>
#include <QFont>
#include <QIconEngine>
#include <QLabel>
#include <QPainter>
#include <QPalette>
#include <QStyle>
#include <QStyleFactory>
#include <QSvgRenderer>
#include <QToolButton>
#include <QVariant>
#include <array>
#include <utility>

#include "core/error.h"
#include "core/file.h"
#include "core/skeleton/skeleton.h"

namespace sinew {
namespace {

const QColor kDisabled{0x9a, 0xa6, 0xb1};

/// Draws an SVG whose lines are "currentColor"; paler while disabled.
class LineIconEngine : public QIconEngine {
 public:
  LineIconEngine(QByteArray svg, QColor color) : svg_{std::move(svg)}, color_{std::move(color)} {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State) override {
    QColor color = color_;
    if (mode == QIcon::Disabled) color = kDisabled;
    QByteArray text = svg_;
    text.replace("currentColor", color.name(QColor::HexRgb).toLatin1());
    painter->save();
    painter->setOpacity(painter->opacity() * color.alphaF());
    QSvgRenderer{text}.render(painter, QRectF{rect});
    painter->restore();
  }
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    QPixmap picture{size};
    picture.fill(Qt::transparent);
    QPainter painter{&picture};
    paint(&painter, QRect{QPoint{0, 0}, size}, mode, state);
    return picture;
  }
  QIconEngine* clone() const override { return new LineIconEngine{svg_, color_}; }

 private:
  QByteArray svg_;
  QColor color_;
};

QString withColours(QString sheet) {
  // longer names first: "@primary_dark" starts with "@primary"
  const std::array<std::pair<const char*, QColor>, 21> names{{{"@success_tint", colour::kSuccessTint},
                                                              {"@warning_tint", colour::kWarningTint},
                                                              {"@danger_tint", colour::kDangerTint},
                                                              {"@primary_dark", colour::kPrimaryDark},
                                                              {"@view_strip", colour::kViewStrip},
                                                              {"@background", colour::kBackground},
                                                              {"@selection", colour::kSelection},
                                                              {"@disabled", kDisabled},
                                                              {"@primary", colour::kPrimary},
                                                              {"@pressed", QColor{0xe4, 0xe9, 0xee}},
                                                              {"@surface", colour::kSurface},
                                                              {"@success", colour::kSuccess},
                                                              {"@warning", colour::kWarning},
                                                              {"@border", colour::kBorder},
                                                              {"@danger", colour::kDanger},
                                                              {"@hover", QColor{0xee, 0xf2, 0xf5}},
                                                              {"@muted", colour::kMuted},
                                                              {"@text", colour::kText},
                                                              {"@line", colour::kLine},
                                                              {"@view", colour::kView},
                                                              {"@ink", colour::kInk}}};
  for (const auto& [name, color] : names) sheet.replace(QLatin1String{name}, color.name());
  return sheet;
}

}  // namespace

void installTheme(QApplication& application, const std::filesystem::path& resource_dir) {
  QDir::setSearchPaths("icons", {QString::fromStdString((resource_dir / "icons").string())});
  application.setStyle(QStyleFactory::create("Fusion"));
  QFont font;
  font.setFamilies({"DejaVu Sans", "NanumBarunGothic", "NanumGothic"});
  font.setPixelSize(12);
  application.setFont(font);
  QPalette palette;
  palette.setColor(QPalette::Window, colour::kBackground);
  palette.setColor(QPalette::Base, colour::kSurface);
  palette.setColor(QPalette::AlternateBase, colour::kBackground);
  palette.setColor(QPalette::Text, colour::kText);
  palette.setColor(QPalette::WindowText, colour::kText);
  palette.setColor(QPalette::ButtonText, colour::kText);
  palette.setColor(QPalette::PlaceholderText, QColor{0x7c, 0x89, 0x95});
  palette.setColor(QPalette::Highlight, colour::kPrimary);
  palette.setColor(QPalette::HighlightedText, Qt::white);
  application.setPalette(palette);
  application.setStyleSheet(withColours(QString::fromStdString(readFile(resource_dir / "theme" / "window.css"))));
}

QIcon icon(const QString& name, const QColor& color) {
  QFile file{"icons:" + name + ".svg"};
  require(file.open(QIODevice::ReadOnly), "no icon " + name.toStdString());
  return QIcon{new LineIconEngine{file.readAll(), color}};
}

QColor sideColour(std::string_view name) {
  if (name.ends_with("_r")) return colour::kRight;
  return name.ends_with("_l") ? colour::kLeft : colour::kMidline;
}

void setRole(QWidget* widget, const char* property, const QVariant& value) {
  if (widget->property(property) == value) return;
  widget->setProperty(property, value);
  widget->style()->unpolish(widget);
  widget->style()->polish(widget);
}

QLabel* makeLabel(const QString& text, const char* role, QWidget* parent) {
  auto* label = new QLabel{text, parent};
  label->setProperty("role", role);
  return label;
}

QToolButton* makeToolButton(const QString& object_name, const QString& icon_name, const QString& tip, QWidget* parent,
                            const QColor& color) {
  auto* button = new QToolButton{parent};
  button->setObjectName(object_name);
  button->setIcon(icon(icon_name, color));
  button->setIconSize({18, 18});
  button->setToolTip(tip);
  button->setAccessibleName(tip);
  button->setAutoRaise(true);
  return button;
}

}  // namespace sinew
