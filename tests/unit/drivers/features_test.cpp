// The DK1's feature reports: published vectors, ranges, and display info that other software has destroyed.
#include "drivers/dk1/features.h"
#include "tests/unit/drivers/support.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace arift;
using namespace arift::dk1;

namespace
{

template <typename Report> void expectBytes(const Report &report, const char *hex)
{
	const auto bytes = encode(report);
	const auto expected = test::fromHex(hex);
	EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), expected.begin(), expected.end())) << hex;
}

} // namespace

TEST(Features, EncodeTheVectors)
{
	expectBytes(KeepAlive{}, "08 00 00 10 27");
	expectBytes(SensorConfig{}, "02 00 00 2c 01 e8 03");
	expectBytes(SensorRange{}, "04 00 00 02 d0 07 14 05");
	expectBytes(SensorRange{.milligauss = 2500}, "04 00 00 02 d0 07 c4 09");
	expectBytes(DisplayInfo{}, "09 00 00 01 00 05 20 03 00 49 02 00 a0 6d 01 00 d0 b6 00 00 0c f8 00 00 88 c2 00 00 88 c2 00 00 "
							   "00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00");
}

TEST(Features, DecodeWhatTheyEncode)
{
	const auto config = decodeSensorConfig(encode(SensorConfig{.command = 0x1234, .packetInterval = 9}));
	ASSERT_TRUE(config);
	EXPECT_EQ(config->command, 0x1234);
	EXPECT_EQ(config->packetInterval, 9);
	const auto range = decodeSensorRange(encode(SensorRange{.accelerationG = 16, .degreesPerSecond = 500}));
	ASSERT_TRUE(range);
	EXPECT_EQ(range->accelerationG, 16);
	EXPECT_EQ(range->degreesPerSecond, 500);
	EXPECT_EQ(decodeKeepAlive(encode(KeepAlive{.intervalMs = 777}))->intervalMs, 777);
	EXPECT_FALSE(decodeSensorRange(encode(SensorRange{.accelerationG = 3})));
	EXPECT_FALSE(decodeKeepAlive(encode(SensorConfig{})));
	EXPECT_FALSE(decodeSensorConfig(std::span<const std::byte>()));
}

TEST(Features, DisplayInfoThatCannotBeIsRefused)
{
	const auto good = decodeDisplayInfo(encode(DisplayInfo{}));
	ASSERT_TRUE(good);
	EXPECT_DOUBLE_EQ(good->lensSeparation, 0.0635);
	EXPECT_DOUBLE_EQ(good->widthMetres, 0.14976);
	const DisplayInfo bad[] = {{.distortionType = 0}, {.width = 0},          {.height = 65535},         {.widthMetres = 14.976},
							   {.heightMetres = 0},   {.verticalCentre = 1}, {.lensSeparation = 0.635}, {.lensToScreen = {0.0498, 0}}};
	for (size_t i = 0; i < std::size(bad); i++) EXPECT_FALSE(decodeDisplayInfo(encode(bad[i]))) << i;
	EXPECT_FALSE(decodeDisplayInfo(std::vector<std::byte>(56)));
}

TEST(Features, DistortionCoefficientsCountOnlyWhereTheTypeSaysSo)
{
	DisplayInfo garbage{.distortion = {NAN, 1.6e-27f, NAN, 3.4e16f, 0, 0}};
	const auto asRealUnits = decodeDisplayInfo(encode(garbage));
	ASSERT_TRUE(asRealUnits) << "type 1 with garbage behind it is what real units hold";
	EXPECT_EQ(asRealUnits->distortion[3], 0);
	garbage.distortionType = 2;
	EXPECT_FALSE(decodeDisplayInfo(encode(garbage)));
	const auto valid = decodeDisplayInfo(encode(DisplayInfo{.distortionType = 2, .distortion = {1, 0.22f, 0.24f, 0, 0, 0}}));
	ASSERT_TRUE(valid);
	EXPECT_EQ(valid->distortion[2], 0.24f);
}
