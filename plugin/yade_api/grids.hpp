// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// YADE's bodies that deform with nodes: members of grids, membranes, and chains of cylinders.
#include "yade_api/body.hpp"

#pragma GCC visibility push(default)
namespace yade {

class GridNode : public Sphere {
	GridNode();

public:
	vector<shared_ptr<Body>> pfacetList, ConnList;
	~GridNode() override;
	YADE_API_OVERRIDES(GridNode)
	YADE_API_INDEX_DERIVED
};

class GridConnection : public Sphere {
	GridConnection();

public:
	shared_ptr<Body>         node1, node2;
	bool                     periodic;
	vector<shared_ptr<Body>> pfacetList;
	Vector3i                 cellDist;
	~GridConnection() override;
	YADE_API_OVERRIDES(GridConnection)
	YADE_API_INDEX_DERIVED
};

class PFacet : public Shape {
	PFacet();

public:
	Vector3r         ne[3];
	Real             icr, vl[3];
	Vector3r         vu[3];
	shared_ptr<Body> node1, node2, node3, conn1, conn2, conn3;
	Vector3r         normal;
	Real             radius, area;
	Vector3i         cellDist;
	~PFacet() override;
	YADE_API_OVERRIDES(PFacet)
	YADE_API_INDEX_DERIVED
};

class Cylinder : public Sphere {
	Cylinder();

public:
	Real     length;
	Vector3r segment;
	~Cylinder() override;
	YADE_API_OVERRIDES(Cylinder)
	YADE_API_INDEX_DERIVED
};

class ChainedCylinder : public Cylinder {
	ChainedCylinder();

public:
	Real        initLength;
	Quaternionr chainedOrientation;
	~ChainedCylinder() override;
	YADE_API_OVERRIDES(ChainedCylinder)
	YADE_API_INDEX_DERIVED
};

class ChainedState : public State {
	ChainedState();

public:
	vector<Body::id_t> barContacts, nodeContacts;
	unsigned           rank, chainNumber;
	int                bId;
	~ChainedState() override;
	YADE_API_OVERRIDES(ChainedState)
	YADE_API_INDEX_DERIVED
};

} // namespace yade
#pragma GCC visibility pop
