// SPDX-License-Identifier: GPL-2.0-or-later
// Forces on positions that move with the nodes of a cell, and their derivatives.
#pragma once
#include "core/grid/attachment.hpp"
#include "core/terms/term.hpp"

namespace gimpm {

/// Calls f(a, b, code of the offset from a to b, product of the weights) for each node a of one position and each node
/// b of another, no farther than a cell away.
template <int Dim, template <int> class Attached, class F> void forNodePairs(const Attached<Dim>& from, const Attached<Dim>& to, F&& f)
{
	for (int m = 0; m < from.nodes; ++m)
		for (int n = 0; n < to.nodes; ++n) {
			const Index<Dim> offset = to.index(n) - from.index(m);
			f(from.node[m], to.node[n], NodeMatrix<Dim>::code(offset), from.weight[m] * to.weight[n]);
		}
}

/// Marks what addAttachedStiffness writes.
template <int Dim, template <int> class Attached> void markAttached(const Attached<Dim>& from, const Attached<Dim>& to, NodeMatrix<Dim>& K)
{
	forNodePairs<Dim>(from, to, [&](int a, int, int code, double) {
		if (code >= 0) K.markUsed(a, code);
	});
}

/// `tangent`: derivative, by where the second position is, of the force on the body at the first one.
template <int Dim, template <int> class Attached>
void addAttachedStiffness(const Attached<Dim>& from, const Attached<Dim>& to, const Mat<Dim>& tangent, NodeMatrix<Dim>& K)
{
	forNodePairs<Dim>(from, to, [&](int a, int b, int code, double weight) { K.add(a, b, code, -weight * tangent); });
}

/// A force on the body, which therefore does not resist.
template <int Dim, template <int> class Attached> void addAttachedForce(const Attached<Dim>& at, const Vec<Dim>& force, const AssembledTerms<Dim>& sum)
{
	for (int n = 0; n < at.nodes; ++n) {
		const Vec<Dim> f = at.weight[n] * force;
		sum.force.template segment<Dim>(Dim * at.node[n]) -= f;
		if (sum.absoluteContributions) sum.absoluteContributions->template segment<Dim>(Dim * at.node[n]) += f.cwiseAbs();
	}
}

/// Constrains a position along a direction, and, where it sticks, along all.
template <int Dim> void constrainAttached(const Attachment<Dim>& at, const Vec<Dim>& normal, bool sticks, const typename Term<Dim>::Constrain& constrain)
{
	constrain(at.node[0], normal, at.inCell());
	for (int a = 0; sticks && a < Dim; ++a)
		constrain(at.node[0], Vec<Dim>::Unit(a), at.inCell());
}

} // namespace gimpm
