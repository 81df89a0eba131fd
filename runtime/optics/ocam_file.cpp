// OCamCalib's calib_results.txt as its export_data.m writes it: comments start with #, five lines of numbers in fixed order.
#include "runtime/base/error.h"
#include "runtime/optics/camera_model.h"
#include "runtime/optics/models.h"
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace arift
{

namespace
{

constexpr std::array<const char *, 5> parts{"direct polynomial", "inverse polynomial", "centre", "affine parameters", "image size"};

struct NumberLine {
	int line;
	std::vector<double> numbers;
};

double parsed(const std::string &file, int line, const char *part, const std::string &word)
{
	double value = 0;
	const char *first = word.data() + (word.starts_with('+') ? 1 : 0), *last = word.data() + word.size();
	const auto [end, error] = std::from_chars(first, last, value);
	if (error != std::errc() || end != last || !std::isfinite(value))
		throw InputError("{}:{}: {} contains \"{}\", expected numbers only", file, line, part, word);
	return value;
}

std::vector<NumberLine> readLines(const std::string &file)
{
	if (!std::filesystem::is_regular_file(file)) throw InputError("{}: no such file, expected an OCamCalib calibration", file);
	std::ifstream stream(file);
	if (!stream) throw InputError("{}: cannot be read", file);
	std::vector<NumberLine> lines;
	std::string text, word;
	int number = 0;
	while (std::getline(stream, text)) {
		++number;
		std::istringstream words(text);
		if (!(words >> word) || word.starts_with('#')) continue;
		if (lines.size() == parts.size()) throw InputError("{}:{}: \"{}\", expected nothing after the image size", file, number, word);
		NumberLine line{number, {}};
		do line.numbers.push_back(parsed(file, number, parts[lines.size()], word));
		while (words >> word);
		lines.push_back(std::move(line));
	}
	if (lines.size() < parts.size()) throw InputError("{}:{}: the file ends, expected the {}", file, number, parts[lines.size()]);
	return lines;
}

/// A line that starts with the count of what follows.
std::vector<double> polynomial(const std::string &file, const NumberLine &line, const char *part)
{
	const double count = line.numbers[0];
	if (count != std::floor(count) || count < 1 || count > 100)
		throw InputError("{}:{}: {} starts with {}, expected its number of coefficients, 1 to 100", file, line.line, part, count);
	if (line.numbers.size() - 1 != size_t(count))
		throw InputError("{}:{}: {} has {} coefficients, expected {} as its first number says", file, line.line, part,
						 line.numbers.size() - 1, count);
	return {line.numbers.begin() + 1, line.numbers.end()};
}

void expectCount(const std::string &file, const NumberLine &line, const char *part, size_t count, const char *expected)
{
	if (line.numbers.size() != count)
		throw InputError("{}:{}: {} has {} numbers, expected {}", file, line.line, part, line.numbers.size(), expected);
}

uint32_t pixels(const std::string &file, const NumberLine &line, size_t index, const char *what)
{
	const double value = line.numbers[index];
	if (value != std::floor(value) || value < 1 || value > 16384)
		throw InputError("{}:{}: image {} = {}, expected a whole number from 1 to 16384", file, line.line, what, value);
	return uint32_t(value);
}

void checkCentre(const std::string &file, int line, const OCam &camera, uint32_t width, uint32_t height)
{
	if (!(camera.centreRow > -0.5 && camera.centreRow < height - 0.5))
		throw InputError("{}:{}: centre row = {}, expected inside the image of {} rows", file, line, camera.centreRow, height);
	if (!(camera.centreColumn > -0.5 && camera.centreColumn < width - 0.5))
		throw InputError("{}:{}: centre column = {}, expected inside the image of {} columns", file, line, camera.centreColumn, width);
}

} // namespace

CameraModel readOCamFile(const std::string &file)
{
	const std::vector<NumberLine> lines = readLines(file);
	OCam camera;
	camera.direct = polynomial(file, lines[0], parts[0]);
	camera.inverse = polynomial(file, lines[1], parts[1]);
	expectCount(file, lines[2], parts[2], 2, "2: row and column");
	expectCount(file, lines[3], parts[3], 3, "3: c, d and e");
	expectCount(file, lines[4], parts[4], 2, "2: height and width");
	camera.centreRow = lines[2].numbers[0];
	camera.centreColumn = lines[2].numbers[1];
	camera.c = lines[3].numbers[0];
	camera.d = lines[3].numbers[1];
	camera.e = lines[3].numbers[2];
	const uint32_t height = pixels(file, lines[4], 0, "height"), width = pixels(file, lines[4], 1, "width");
	checkCentre(file, lines[2].line, camera, width, height);
	try {
		CameraModel model(width, height, std::move(camera));
		models::warnAboutInverse(fmt::format("{}:{}", file, lines[1].line), model);
		return model;
	} catch (const models::OCamError &error) {
		throw InputError("{}:{}: {}", file, lines[size_t(error.part)].line, error.what());
	} catch (const InputError &error) {
		throw InputError("{}:{}: direct polynomial: {}", file, lines[0].line, error.what());
	}
}

} // namespace arift
