#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "lacuna/error.hpp"
#include "lacuna/settings.hpp"
#include "lacuna/toml.hpp"

using lacuna::Settings;
using lacuna::toml::Document;

namespace {

std::string paper_settings() {
  std::ostringstream text;
  text << std::ifstream(PAPER_SETTINGS).rdbuf();
  return text.str();
}

std::string replaced(std::string text, const std::string &what, const std::string &by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

std::string message_of(const std::string &text) {
  try {
    Settings::parse(text);
  } catch (const lacuna::Error &error) {
    return error.what();
  }
  return "accepted";
}

} // namespace

TEST(Toml, ReadsTablesAndValues) {
  const Document document(
      "a = 1.5e-3 # comment\n[t]\nb = \"x # y\"\nc = [ \"p\", \"q\" ]\r\n\n[[r]]\nk=1\n[[r]]\nk=-2\n");
  EXPECT_DOUBLE_EQ(document.table("").number("a"), 1.5e-3);
  EXPECT_EQ(document.table("t").text("b"), "x # y");
  EXPECT_EQ(document.table("t").texts("c"), (std::vector<std::string>{"p", "q"}));
  ASSERT_EQ(document.tables("r").size(), 2u);
  EXPECT_EQ(document.tables("r")[1].number("k"), -2);
}

TEST(Toml, RefusesTheRestWithItsLine) {
  for (const char *text :
       {"\na", "\na = ", "\na = 'x'", "\n[t", "\na = \"x", "\na = 1 2", "\na = [1, 2", "\na = 1.2.3"}) {
    try {
      const Document document(text);
      FAIL() << text;
    } catch (const lacuna::Error &error) {
      EXPECT_NE(std::string(error.what()).find("line 2"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(Document("a = 1\na = 2"), lacuna::Error);
  EXPECT_THROW(Document("[t]\n[t]"), lacuna::Error);
  EXPECT_THROW(Document("a = " + std::string(1000000, '[')), lacuna::Error);
}

TEST(Settings, OfThePaper) {
  const Settings settings = Settings::parse(paper_settings());
  EXPECT_EQ(settings.samples(), 100000u);
  EXPECT_EQ(settings.padded_length(25000), 131072u);
  EXPECT_EQ(settings.currents.size(), 3u);
  ASSERT_EQ(settings.bands.size(), 4u);
  EXPECT_EQ(settings.bands[3].name, "violet");
}

TEST(Settings, PaddingByName) {
  const Settings by_section =
      Settings::parse(replaced(paper_settings(), "padding = \"record\"", "padding = \"section\""));
  EXPECT_EQ(by_section.padded_length(25000), 32768u);
  const Settings none = Settings::parse(replaced(paper_settings(), "padding = \"record\"", "padding = \"none\""));
  EXPECT_EQ(none.padded_length(25000), 25000u);
  EXPECT_EQ(none.padded_length(25001), 25002u);
}

TEST(Settings, NameTheEntryThatIsWrong) {
  const std::string good = paper_settings();
  EXPECT_NE(
      message_of(replaced(good, "sampling_rate = 100000.0", "sampling_rate = -1")).find("recording.sampling_rate"),
      std::string::npos);
  EXPECT_NE(message_of(replaced(good, "duration", "length")).find("recording.duration is missing"), std::string::npos);
  EXPECT_NE(
      message_of(replaced(good, "overlap = 0.67", "overlap = \"much\"")).find("spectrum.overlap must be a number"),
      std::string::npos);
  EXPECT_NE(message_of(replaced(good, "overlap = 0.67", "overlap = 1.5")).find("spectrum.overlap"), std::string::npos);
  EXPECT_NE(message_of(replaced(good, "[first_peak]", "[peak]")).find("first_peak"), std::string::npos);
  EXPECT_NE(message_of(replaced(good, "padding = \"record\"", "padding = \"twice\"")).find("twice"), std::string::npos);
}
