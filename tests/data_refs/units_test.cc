// SPDX-License-Identifier: Apache-2.0
// Every spelling of a unit is that unit, and what is none of them is nothing.
#include "data_refs/units.h"

#include <gtest/gtest.h>

namespace skyfit::refs {
namespace {

TEST(Units, AreFoundInEverySpelling) {
  for (const char* text : {"W m-2 sr-1 nm-1", "W m^-2 sr^-1 nm^-1", "W/m2/sr/nm", "W/m^2/sr/nm",
                           "W/(m^2 sr nm)", "W sr-1 m-2 nm-1", "W*m^-2*sr^-1*nm^-1"}) {
    const auto unit = find_unit(text);
    ASSERT_TRUE(unit.has_value()) << text;
    EXPECT_EQ(unit->name, "W m-2 sr-1 nm-1") << text;
  }
  EXPECT_EQ(find_unit("kcd/m^2")->factor, 1000);
  EXPECT_EQ(find_unit("uW/cm^2/sr/nm")->factor, 0.01);
  EXPECT_EQ(find_unit("relative")->quantity, Quantity::kRelativeLuminance);
}

TEST(Units, OthersAreNothing) {
  for (const char* text : {"", "W", "W m-2 sr-1", "lux", "cd", "cd m2",
                           "W m-2 sr-1 nm"
                           "W;m-2",
                           "kW m-2 sr-1 nm-1"}) {
    EXPECT_FALSE(find_unit(text).has_value()) << text;
  }
}

TEST(Units, OtherSpellingsAreTheSame) {
  for (const char* text :
       {"uW/cm\u00b2/sr/nm", "\u00b5W cm\u207b\u00b2 sr\u207b\u00b9 nm\u207b\u00b9",
        "\u03bcW/cm^2/sr/nm", "uW/cm^2/sr\\nm", "uW cm**-2 sr**-1 nm**-1"}) {
    ASSERT_TRUE(find_unit(text)) << text;
    EXPECT_EQ(find_unit(text)->name, "uW cm-2 sr-1 nm-1") << text;
  }
  EXPECT_EQ(find_unit("mW/cm^2/sr/um")->factor, find_unit("uW/cm^2/sr/nm")->factor);
}

TEST(Units, AreListedByQuantity) {
  EXPECT_EQ(unit_names({Quantity::kLuminance, Quantity::kRelativeLuminance}),
            "cd m-2, kcd m-2, relative");
  EXPECT_EQ(units().size(), 8u);
}

}  // namespace
}  // namespace skyfit::refs
