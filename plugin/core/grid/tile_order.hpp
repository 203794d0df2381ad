// SPDX-License-Identifier: GPL-2.0-or-later
// Tiles: blocks of cells whose points are done one after the other, and their colours, which are done side by side.
#pragma once
#include "core/grid/grid.hpp"

namespace gimpm {

/// Position of a cell in the order of colours, of the tiles of a colour and of the cells of a tile. Domains with the
/// lowest cell in a tile reach the first nodes beyond it, and no others as long as a tile is at least two cells wide:
/// between two tiles of a colour lies another. Each level of cells and each layer has tiles of its own, which share no
/// node with those of others.
template <int Dim> struct TileOrder {
	static constexpr int widthBits = 2; ///< a tile is 2^widthBits cells wide
	static constexpr int bits = Grid<Dim>::keyBits, highBits = bits - widthBits - 1;

	static Key of(Key cell)
	{
		const int level  = Grid<Dim>::level(cell);
		const Key above  = cell >> Dim * bits;
		Key       colour = 0, tile = 0, inside = 0;
		for (int a = Dim - 1; a >= 0; --a, cell <<= bits) {
			const Key along = low(cell >> bits * (Dim - 1), bits) >> level;
			inside          = inside << widthBits | low(along, widthBits);
			colour          = colour << 1 | low(along >> widthBits, 1);
			tile            = tile << highBits | along >> (widthBits + 1);
		}
		return above << Dim * bits | (colour << Dim * highBits | tile) << Dim * widthBits | inside;
	}
	static Key cell(Key position)
	{
		const int level   = Grid<Dim>::level(position);
		Key       cell    = position >> Dim * bits << Dim * bits;
		const Key colours = position >> Dim * (bits - 1), tiles = tile(position);
		for (int a = 0; a < Dim; ++a) {
			const Key along = low(tiles >> a * highBits, highBits) << 1 | low(colours >> a, 1);
			cell |= (along << widthBits | low(position >> a * widthBits, widthBits)) << (a * bits + level);
		}
		return cell;
	}
	static Key tile(Key position) { return position >> Dim * widthBits; } ///< tile with colour, level and layer

private:
	static constexpr Key low(Key k, int bits) { return k & ((Key(1) << bits) - 1); }
};

/// Along one axis tiles take turns. Where the grid repeats itself, the last of an odd number of tiles meets the first,
/// of its own colour; so does the last but one where the last is a single cell, beyond which its domains reach.
template <int Dim> int colourAlong(int tile, int period)
{
	constexpr int width      = 1 << TileOrder<Dim>::widthBits;
	const int     tiles      = (period + width - 1) / width;
	const bool    meetsFirst = tiles % 2 != 0 ? tile == tiles - 1 : tile == tiles - 2 && period % width == 1;
	return period != 0 && meetsFirst ? 2 : tile & 1;
}

/// Number of colours.
template <int Dim> int coloursOf(const Grid<Dim>& grid) { return grid.isPeriodic() ? (Dim == 2 ? 9 : 27) : 1 << Dim; }

template <int Dim> int colourOf(Key cell, const Grid<Dim>& grid)
{
	const Index<Dim> i      = Grid<Dim>::index(cell);
	int              colour = 0;
	for (int a = Dim - 1; a >= 0; --a)
		colour = (grid.isPeriodic() ? 3 : 2) * colour + colourAlong<Dim>(i[a] >> (TileOrder<Dim>::widthBits + Grid<Dim>::level(cell)), grid.period[a]);
	return colour;
}

} // namespace gimpm
