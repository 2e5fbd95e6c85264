#include <gtest/gtest.h>

#include "lacuna/error.hpp"
#include "lacuna/sections.hpp"

using lacuna::Sections;

TEST(Sections, QuartersOfAnOverlappingRecordAsInThePaper) {
  const Sections sections(100000, 0.25, 0.67);
  EXPECT_EQ(sections.length(), 25000u);
  EXPECT_EQ(sections.hop(), 8250u);
  EXPECT_EQ(sections.count(), 10u);
  EXPECT_LE(sections.start(9) + sections.length(), 100000u);
  EXPECT_GT(sections.start(10) + sections.length(), 100000u);
}

TEST(Sections, TheWholeRecordIsOneSection) {
  const Sections sections(1000, 1.0, 0.5);
  EXPECT_EQ(sections.count(), 1u);
  EXPECT_EQ(sections.length(), 1000u);
}

TEST(Sections, WithoutOverlapTheyTouch) {
  const Sections sections(1000, 0.25, 0.0);
  EXPECT_EQ(sections.count(), 4u);
  EXPECT_EQ(sections.start(3), 750u);
}

TEST(Sections, RefuseWhatCutsNothing) {
  EXPECT_THROW(Sections(1000, 0.0, 0.5), lacuna::Error);
  EXPECT_THROW(Sections(1000, 1.5, 0.5), lacuna::Error);
  EXPECT_THROW(Sections(1000, 0.25, 1.0), lacuna::Error);
  EXPECT_THROW(Sections(1000, 0.25, 0.9999), lacuna::Error);
  EXPECT_THROW(Sections(4, 0.25, 0.5), lacuna::Error);
}
