// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/messages/ProgressLine.hpp"
#include <cmath>
#include <cstdio>
#include <sstream>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

namespace yade {

namespace {
	// 75 -> "1:15", 3675 -> "1:01:15"
	std::string clockTime(double seconds)
	{
		const long whole = std::lround(seconds);
		char       text[32];
		if (whole < 3600) std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
		else
			std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
		return text;
	}

	// Two digits, and no power of ten: 0.034, 3.4, 34, 3400
	std::string perSecond(double rate)
	{
		const double       unit = std::pow(10, std::floor(std::log10(rate)) - 1);
		std::ostringstream text;
		text.precision(2);
		if (rate < 10) text << rate;
		else
			text << std::lround(std::lround(rate / unit) * unit);
		return text.str();
	}

	// YADE's prompt waits for keys, one by one: redrawing would wipe out what has been typed.
	bool somebodyTypes()
	{
		termios settings {};
		return tcgetattr(STDIN_FILENO, &settings) == 0 && !(settings.c_lflag & ICANON);
	}

	// A line that wraps could not be redrawn.
	std::string fitted(const std::string& line)
	{
		winsize window {};
		if (ioctl(STDERR_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_col == 0) return line;
		return line.substr(0, window.ws_col - 1);
	}
}

void ProgressLine::start(long iter)
{
	if (!isRunning || iter < latest) {
		begin = shown = Clock::now();
		first = iter, begun = 0;
		isRunning = true;
	}
	latest = iter, ++begun;
}

void ProgressLine::show(const Progress& now, int level)
{
	if (level == 0) return;
	const bool inPlace = level == 1 && now.inBackground && isatty(STDERR_FILENO) && !somebodyTypes();
	if (isDue(now, level, inPlace)) {
		shown = Clock::now();
		if (inPlace) std::fprintf(stderr, "\r\033[K%s", fitted(text(now)).c_str());
		else
			std::fprintf(stderr, "%s\n", text(now).c_str());
		std::fflush(stderr);
		isOpen = inPlace;
	}
	if (now.ends || (isOpen && !now.inBackground)) end(); // at its end, or by O.pause()
}

void ProgressLine::breakLine()
{
	if (isOpen) std::fputs("\n", stderr);
	isOpen = false;
}

void ProgressLine::end()
{
	breakLine();
	isRunning = false;
}

bool ProgressLine::isDue(const Progress& now, int level, bool inPlace) const
{
	const std::chrono::duration<double> since = Clock::now() - shown;
	return level > 1 || now.ends || since.count() >= (inPlace ? 0.1 : 10);
}

std::string ProgressLine::text(const Progress& now) const
{
	const double       elapsed = std::chrono::duration<double>(Clock::now() - begin).count();
	const long         done    = now.step - first;
	std::ostringstream line;
	line << now.place << ", step " << now.step;
	if (now.lastStep >= now.step) line << "/" << now.lastStep;
	line << ", " << clockTime(elapsed) << " elapsed, ";
	if (now.lastStep > now.step) line << clockTime(elapsed / done * (now.lastStep - now.step)) << " left, ";
	if (now.inTime && elapsed > 0) line << perSecond(begun / elapsed) << " steps/s, ";
	if (!std::isnan(now.residual)) {
		line << now.iterations << " iterations, " << now.cuts << " cuts, residual ";
		line.precision(2);
		line << now.residual << ", ";
	}
	line << now.points << " points";
	return line.str();
}

} // namespace yade
