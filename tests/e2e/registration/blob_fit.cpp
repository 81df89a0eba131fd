#include "tests/e2e/registration/blob_fit.h"
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace arift::e2e
{
namespace
{

using Eigen::Vector2d;

struct Box {
	int left, top, right, bottom; ///< pixels; right and bottom beyond the last
};

/// Linear light of one panel picture.
class Light
{
public:
	explicit Light(const PanelPicture &picture) : picture_(picture)
	{
		for (size_t i = 0; i < linear_.size(); ++i) {
			const double v = double(i) / 255;
			linear_[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
		}
	}
	double at(int x, int y, int channel) const
	{
		return linear_[picture_.rgba[(size_t(y) * picture_.width + size_t(x)) * 4 + size_t(channel)]];
	}
	int height() const { return int(picture_.height); }
	int halfWidth() const { return int(picture_.width) / 2; }

private:
	const PanelPicture &picture_;
	std::array<double, 256> linear_{};
};

/// Boxes around connected places that shine in `channel` and not in green.
std::vector<Box> connected(const Light &light, int eye, int channel)
{
	const int width = light.halfWidth(), height = light.height(), start = eye * width;
	std::vector<uint8_t> bright(size_t(width) * size_t(height));
	for (int y = 0; y < height; ++y)
		for (int x = 0; x < width; ++x) {
			const double value = light.at(start + x, y, channel);
			bright[size_t(y * width + x)] = value > 0.15 && light.at(start + x, y, 1) < 0.3 * value;
		}
	std::vector<Box> boxes;
	std::vector<int> front;
	for (int seed = 0; seed < width * height; ++seed) {
		if (!bright[size_t(seed)]) continue;
		Box box{width, height, 0, 0};
		front.assign(1, seed);
		bright[size_t(seed)] = 0;
		while (!front.empty()) {
			const int at = front.back(), x = at % width, y = at / width;
			front.pop_back();
			box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x + 1), std::max(box.bottom, y + 1)};
			for (const auto &[nx, ny] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}})
				if (nx >= 0 && ny >= 0 && nx < width && ny < height && bright[size_t(ny * width + nx)]) {
					bright[size_t(ny * width + nx)] = 0;
					front.push_back(ny * width + nx);
				}
		}
		boxes.push_back({box.left + start, box.top, box.right + start, box.bottom});
	}
	return boxes;
}

/// Tangent-space area of a panel pixel.
double area(const reference::Lens &lens, int eye, int channel, const Vector2d &pixel)
{
	Eigen::Matrix2d j;
	j << lens.tangents(eye, channel, pixel + Vector2d(0.5, 0)) - lens.tangents(eye, channel, pixel - Vector2d(0.5, 0)),
		lens.tangents(eye, channel, pixel + Vector2d(0, 0.5)) - lens.tangents(eye, channel, pixel - Vector2d(0, 0.5));
	return std::abs(j.determinant());
}

/// The fit looks at an ellipse this much larger than the disc's box; its rim must be dark.
constexpr double fitReach = 1.5, fitRim = 1.3;

std::optional<Spot> fit(const Light &light, const reference::Lens &lens, int eye, int channel, const Box &box)
{
	const int wide = box.right - box.left, high = box.bottom - box.top;
	if (wide < 5 || high < 5 || wide > 120 || high > 120 || wide > 2 * high || high > 2 * wide) return std::nullopt;
	const Vector2d centre((box.left + box.right) / 2.0, (box.top + box.bottom) / 2.0), half(wide / 2.0, high / 2.0);
	const Eigen::Vector2i low = (centre - fitReach * half).array().floor().matrix().cast<int>();
	const Eigen::Vector2i end = (centre + fitReach * half).array().ceil().matrix().cast<int>();
	const int start = eye * light.halfWidth();
	if (low.x() < start || low.y() < 0 || end.x() > start + light.halfWidth() || end.y() > light.height()) return std::nullopt;
	Spot spot;
	double total = 0, brightestRim = 0;
	for (int y = low.y(); y < end.y(); ++y)
		for (int x = low.x(); x < end.x(); ++x) {
			const Vector2d pixel(x + 0.5, y + 0.5);
			const double out = (pixel - centre).cwiseQuotient(half).norm(), value = light.at(x, y, channel);
			if (out > fitReach) continue;
			spot.peak = std::max(spot.peak, value);
			if (out > fitRim) brightestRim = std::max(brightestRim, value);
			const double weight = value * area(lens, eye, channel, pixel);
			spot.tangents += weight * lens.tangents(eye, channel, pixel);
			total += weight;
		}
	if (brightestRim > 0.08 * spot.peak) return std::nullopt;
	spot.tangents /= total;
	return spot;
}

} // namespace

std::vector<Spot> findSpots(const PanelPicture &picture, const reference::Lens &lens, int eye, int channel)
{
	const Light light(picture);
	std::vector<Spot> spots;
	for (const Box &box : connected(light, eye, channel))
		if (const auto spot = fit(light, lens, eye, channel, box)) spots.push_back(*spot);
	return spots;
}

std::vector<Pair> pairSpots(const reference::Lens &lens, int eye, const std::vector<Spot> &real, const std::vector<Spot> &holograms,
							double reach, size_t &lonely)
{
	std::vector<Pair> pairs;
	for (const Spot &thing : real) {
		const auto distance = [&](const Spot &spot) { return (spot.tangents - thing.tangents).norm(); };
		const auto nearest = std::ranges::min_element(holograms, [&](const Spot &a, const Spot &b) { return distance(a) < distance(b); });
		if (nearest == holograms.end() || distance(*nearest) > reach) {
			++lonely;
			continue;
		}
		const auto from = lens.pixel(eye, 1, thing.tangents), to = lens.pixel(eye, 1, nearest->tangents);
		if (from && to) pairs.push_back({eye, thing, *nearest, *to - *from});
	}
	return pairs;
}

} // namespace arift::e2e
