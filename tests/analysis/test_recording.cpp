#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "lacuna/error.hpp"
#include "lacuna/recording.hpp"

using lacuna::Recording;

namespace {

Recording read(const std::string &csv, const std::vector<std::string> &columns = {"i[1,2]"}, std::size_t samples = 3) {
  std::istringstream stream(csv);
  return Recording::read(stream, columns, "phi", 10.0, samples);
}

std::string message_of(const std::string &csv) {
  try {
    read(csv);
  } catch (const lacuna::Error &error) {
    return error.what();
  }
  return "accepted";
}

} // namespace

TEST(Recording, ReadsNamedColumnsInAnyOrder) {
  const auto recording = read("time,w,\"i[1,2]\"\r\n0,5,1\r\n0.1,6,2\r\n0.2,7,-3e-1\r\n", {"i[1,2]", "w"});
  EXPECT_EQ(recording.column(0)[2], -0.3);
  EXPECT_EQ(recording.column(1)[0], 5);
}

TEST(Recording, TakesAnOptionalColumnWhereThereIsOne) {
  EXPECT_EQ(read("time,\"i[1,2]\",phi\n0,1,5\n0.1,2,6\n0.2,3,7\n").optional()[2], 7);
  EXPECT_TRUE(read("time,\"i[1,2]\"\n0,1\n0.1,2\n0.2,3\n").optional().empty());
}

TEST(Recording, LeavesOutRowsBetweenSamplesThatMarkEvents) {
  const auto recording = read("time,\"i[1,2]\",event\n0,1,0\n0.05,9,1\n0.05,8,1\n0.1,2,0\n0.2,3,0\n0.3,4,0\n");
  EXPECT_EQ(recording.column(0).size(), 3u);
  EXPECT_EQ(recording.column(0)[1], 2);
}

TEST(Recording, AnEventNearASampleIsNotThatSample) {
  const auto recording = read("time,\"i[1,2]\",event\n0,1,0\n0.09999,9,1\n0.09999,8,1\n0.1,2,0\n0.2,3,0\n");
  EXPECT_EQ(recording.column(0)[1], 2);
}

TEST(Recording, AnEmptyFieldIsAMissingSample) {
  EXPECT_TRUE(std::isnan(read("time,\"i[1,2]\"\n0,1\n0.1,\n0.2,3\n").column(0)[1]));
}

TEST(Recording, SaysWhatIsWrongAndWhere) {
  EXPECT_NE(message_of("").find("empty"), std::string::npos);
  EXPECT_NE(message_of("t,\"i[1,2]\"\n").find("first column must be 'time'"), std::string::npos);
  EXPECT_NE(message_of("time,j\n0,1\n").find("no column 'i[1,2]'"), std::string::npos);
  EXPECT_NE(message_of("time,\"i[1,2]\"\n0,1\n0.1,x\n").find("line 3: x is not a number"), std::string::npos);
  EXPECT_NE(message_of("time,\"i[1,2]\"\n0,1\n0.1\n").find("line 3"), std::string::npos);
  EXPECT_NE(message_of("time,\"i[1,2]\"\n0,1\n0.1,1,1\n").find("line 3"), std::string::npos);
  EXPECT_NE(message_of("time,\"i[1,2]\"\n0,1\n0.17,1\n").find("line 3: time"), std::string::npos);
  EXPECT_NE(message_of("time,\"i[1,2]\"\n0,1\nnan,1\n").find("line 3: time"), std::string::npos);
  EXPECT_NE(message_of("time,\"i[1,2]\"\n0,1\n0.1,1\n").find("ends after 2 samples"), std::string::npos);
}

TEST(Recording, RefusesTwoColumnsOfOneName) {
  EXPECT_NE(message_of("time,\"i[1,2]\",\"i[1,2]\"\n0,1,5\n0.1,2,6\n0.2,3,7\n").find("two columns"), std::string::npos);
}
