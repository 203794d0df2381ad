// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/parallel/packed_bodies.hpp"
#include "yade_api/serialization.hpp"
#include <cstring>
#include <sstream>

namespace yade {

namespace {
	// Members of a body besides its state and its shape, which it has of its own.
	struct Envelope {
		int          id, material, flags, clumpId;
		Body::mask_t groupMask;
		long         iterBorn;
		Real         timeBorn;
	};

	template <class Archive> void writeBody(Archive& archive, const Body& body)
	{
		static_assert(std::is_trivially_copyable_v<Envelope>);
		const Envelope envelope { body.id, body.material->id, body.flags, body.clumpId, body.groupMask, body.iterBorn, body.timeBorn };
		string         bytes(sizeof envelope, '\0');
		std::memcpy(bytes.data(), &envelope, sizeof envelope);
		archive << bytes << body.state << body.shape;
	}

	template <class Archive> void readBody(Archive& archive, Scene& scene)
	{
		const shared_ptr<Body> body(new Body);
		string                 bytes;
		Envelope               envelope;
		archive >> bytes >> body->state >> body->shape;
		std::memcpy(&envelope, bytes.data(), sizeof envelope);
		body->material = scene.materials.at(envelope.material);
		scene.bodies->insertAtId(body, envelope.id);
		body->flags     = envelope.flags;
		body->clumpId   = envelope.clumpId;
		body->groupMask = envelope.groupMask;
		body->iterBorn  = envelope.iterBorn;
		body->timeBorn  = envelope.timeBorn;
	}
}

vector<double> packBodies(const Scene& scene, const vector<Body::id_t>& ids)
{
	if (ids.empty()) return {};
	std::ostringstream stream(std::ios::binary);
	{
		boost::archive::binary_oarchive archive(stream);
		const size_t                    count = ids.size();
		archive << count;
		for (const Body::id_t id : ids)
			writeBody(archive, *(*scene.bodies)[id]);
	}
	const string   bytes = stream.str();
	vector<double> numbers(1 + (bytes.size() + sizeof(double) - 1) / sizeof(double));
	numbers[0] = double(bytes.size());
	std::memcpy(numbers.data() + 1, bytes.data(), bytes.size());
	return numbers;
}

void unpackBodies(const vector<double>& numbers, Scene& scene)
{
	if (numbers.empty()) return;
	std::istringstream              stream(string(reinterpret_cast<const char*>(numbers.data() + 1), size_t(numbers[0])), std::ios::binary);
	boost::archive::binary_iarchive archive(stream);
	size_t                          count = 0;
	archive >> count;
	for (size_t i = 0; i < count; ++i)
		readBody(archive, scene);
}

} // namespace yade
