// What is typed into the window's number fields, and what the window says about it.

#include <glm/geometric.hpp>

#include <functional>

#include "app/base/parse_numbers.h"
#include "tests/app/panel_rig.h"

namespace app {
namespace THIS_FILE {

TEST(ParseTyped, TakesACommaAsADecimalPoint) {
  EXPECT_EQ(parse_typed("9,81", false), 9.81);
  EXPECT_EQ(parse_typed(" -0.5 ", false), -0.5);
  EXPECT_EQ(parse_typed("+,5", false), 0.5);
  EXPECT_EQ(parse_typed("1,5e3", false), 1500);
  EXPECT_EQ(parse_typed("47", true), 47);
}

TEST(ParseTyped, RefusesWhatIsNoNumber) {
  for (const char* text : {"", " ", "-", "+-1", "abc", "9,8,1", "1,000.5", "1.000,5", "1e", "5 m", "0x10", "nan", "inf",
                           "1e999", "1 000", "9;81"}) {
    EXPECT_EQ(parse_typed(text, false), std::nullopt) << text;
    EXPECT_EQ(parse_typed(text, true), std::nullopt) << text;
  }
  for (const char* text : {"1,000", "9,5", "2.0", "1e3"}) EXPECT_EQ(parse_typed(text, true), std::nullopt) << text;
}

/// The panel with one section open.
struct FieldRig : PanelRig {
  explicit FieldRig(const char* section) { open(section); }
  /// Types into the field of a number that can be dragged.
  void type_over(std::string_view label, std::string_view text) {
    click_at(700, 500);  // closes the field that is open
    double_click(label);
    type(text);
  }
  const std::string& notice() const { return session.simulation.notice.text(); }
};

/// A number of the panel, and what it is after a text was typed.
struct Field {
  const char *section, *label;
  std::function<double(PanelRig&)> value;
};

const std::vector<Field>& real_fields() {
  static const std::vector<Field> fields{
      {"World", "Gravity", [](PanelRig& r) { return glm::length(r.session.world().scene().gravity); }},
      {"Solids", "Solid position",
       [](PanelRig& r) { return shape_of<softbody::SolidSphere>(r.session.world().scene()).centre.y; }},
      {"Solids", "Solid radius",
       [](PanelRig& r) { return shape_of<softbody::SolidSphere>(r.session.world().scene()).radius; }},
      {"Solids", "Solid restitution",
       [](PanelRig& r) { return solid_of<softbody::SolidSphere>(r.session.world().scene()).restitution; }},
      {"World", "mass",
       [](PanelRig& r) { return r.session.world().scene().materials.at(0)[softbody::Material::mass]; }},
      {"Detection", "Cell size", [](PanelRig& r) { return double{r.session.world().collision().cell_size->x}; }},
      {"Detection", "Tolerance", [](PanelRig& r) { return double{r.session.world().collision().tolerance}; }},
      {"Files", "Size of meshes", [](PanelRig& r) { return double{r.session.import.size}; }},
  };
  return fields;
}

TEST(NumberField, TakesACommaAsADecimalPointAndRefusesAloudWhatItCannotRead) {
  for (const Field& field : real_fields()) {
    SCOPED_TRACE(field.label);
    FieldRig rig(field.section);
    for (const auto& [text, number] : {std::pair{"0,25", 0.25}, {"0.3", 0.3}}) {
      rig.type_over(field.label, text);
      EXPECT_NEAR(field.value(rig), number, 1e-7);
      EXPECT_EQ(rig.notice(), "");
    }
    for (const std::string text : {"9,8,1", "abc", "1,000.5", "2e"}) {
      rig.type_over(field.label, text);
      EXPECT_NEAR(field.value(rig), 0.3, 1e-6) << text;
      EXPECT_NE(rig.notice().find("\"" + text + "\" is not a number; the value stays "), std::string::npos)
          << rig.notice();
      EXPECT_TRUE(rig.shows("Notice"));
    }
  }
}

TEST(NumberField, SaysThatAValueIsBeyondTheLimits) {
  FieldRig rig("World");
  rig.type_over("Gravity", "98,1");
  EXPECT_EQ(rig.notice(), "Gravity: 98,1 is outside 0 to 30 and becomes 30.00");
  rig.type_over("Gravity", "9,81");
  EXPECT_EQ(rig.notice(), "") << "the value is right";
  EXPECT_NEAR(glm::length(rig.session.world().scene().gravity), 9.81, 1e-6);
}

TEST(NumberField, RefusesFractionsAndGroupsWhereTheNumberIsWhole) {
  FieldRig rig("Detection");
  const auto buckets = [&] { return rig.session.world().collision().buckets; };
  const auto levels = [&] { return rig.session.world().collision().levels; };
  const std::uint32_t before = buckets();
  for (const std::string text : {"1,001", "9.5", "x", "12 "}) {
    rig.type_over("Buckets", text);
    EXPECT_EQ(buckets(), text == "12 " ? 12 : before);
    EXPECT_EQ(rig.notice().find("\"" + text + "\" is not a whole number") == std::string::npos, text == "12 ");
  }
  const int level = levels();
  rig.type_over("Level", "2,5");
  EXPECT_EQ(levels(), level);
  EXPECT_NE(rig.notice().find("Level: \"2,5\" is not a whole number"), std::string::npos) << rig.notice();
  rig.type_over("Buckets", "4,5");
  EXPECT_EQ(buckets(), 12u);
}

TEST(NumberField, KeepsTheValueUnderATextThatWasNotChanged) {
  FieldRig rig("World");
  rig.session.simulation.change_scene("Gravity", [&](softbody::Scene& s) { s.gravity = {0, -9.80665, 0}; });
  rig.frames(2);
  rig.type_over("Gravity", "x");
  rig.press_escape();
  EXPECT_NEAR(glm::length(rig.session.world().scene().gravity), 9.80665, 1e-6) << "not the digits shown";
}

TEST(NumberField, SaysWhatIsWrongAlsoWhereThePanelCoversTheScene) {
  FieldRig rig("World");
  rig.resize(500, 1150);
  ASSERT_TRUE(rig.recorder.find("Gravity"));
  rig.double_click("Gravity");
  rig.type("abc");
  EXPECT_TRUE(rig.recorder.find("Notice"));
}

}  // namespace THIS_FILE
}  // namespace app
