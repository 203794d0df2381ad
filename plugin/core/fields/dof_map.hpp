// SPDX-License-Identifier: GPL-2.0-or-later
// Fields over the nodes of a grid, and where their unknowns are in one vector.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace gimpm {

/// Field with unknowns at the nodes. The first field of a system is that of the displacements.
struct Field {
	std::string name, unit;
	int         width = 1; ///< unknowns a node
	/// Growth of the unknowns where displacements grow by 1 m: for a pressure the modulus of the soil over the cell
	/// size. In norms and in the matrix of several fields, unknowns are divided by it and residuals multiplied.
	double scale = 1;
	/// Factor of its rows that makes the matrix symmetric: -1 for a field that pushes the soil apart and is filled
	/// by what it pushes.
	int sign = 1;
};

/// Unknowns of several fields: block after block, and in a block node after node.
class DofMap {
public:
	DofMap() = default;
	DofMap(int nodes, std::vector<Field> fields) : nodes_(nodes), fields_(std::move(fields))
	{
		for (const Field& field : fields_)
			begin_.push_back(begin_.back() + field.width * nodes);
	}

	int          nodes() const { return nodes_; }
	int          fields() const { return int(fields_.size()); }
	bool         isAlone() const { return fields_.size() == 1; } ///< the field of the displacements
	const Field& operator[](int field) const { return fields_[field]; }

	int size() const { return begin_.back(); }
	int begin(int field) const { return begin_[field]; }
	int end(int field) const { return begin_[field + 1]; }
	/// First unknown of a node.
	int at(int field, int node) const { return begin_[field] + fields_[field].width * node; }

	int fieldOf(int unknown) const
	{
		int field = 0;
		while (unknown >= end(field))
			++field;
		return field;
	}

	/// The block of a field.
	auto of(int field, Eigen::VectorXd& all) const { return all.segment(begin(field), end(field) - begin(field)); }
	auto of(int field, const Eigen::VectorXd& all) const { return all.segment(begin(field), end(field) - begin(field)); }

	/// The block of the displacements.
	Eigen::VectorXd displacements(Eigen::VectorXd all) const
	{
		if (!isAlone()) all.conservativeResize(end(0));
		return all;
	}

	std::vector<Eigen::VectorXd> zeros() const
	{
		std::vector<Eigen::VectorXd> blocks;
		for (int f = 0; f < fields(); ++f)
			blocks.push_back(Eigen::VectorXd::Zero(end(f) - begin(f)));
		return blocks;
	}
	Eigen::VectorXd joined(const std::vector<Eigen::VectorXd>& blocks) const
	{
		Eigen::VectorXd all(size());
		for (int f = 0; f < fields(); ++f)
			of(f, all) = blocks[f];
		return all;
	}

private:
	int                nodes_ = 0;
	std::vector<Field> fields_;
	std::vector<int>   begin_ { 0 };
};

} // namespace gimpm
