// SPDX-License-Identifier: GPL-2.0-or-later
#include "MpmSpringBed.hpp"
#include "core/terms/term.hpp"
#include "engine/analysis/analysis.hpp"
#include "yade_api/registration.hpp"

namespace yade {

namespace {
	template <int Dim> using Vec = gimpm::Vec<Dim>;

	// Bed of the core. Elongations are those at the start of a step, without the motion of the plate in it.
	template <int Dim> struct Bed {
		Real                           stiffness;
		int                            layer;                   // layer of nodes
		Vec<Dim>                       lift = Vec<Dim>::Zero(); // lift of the plate in the step
		std::map<gimpm::Key, Vec<Dim>> elongation {};
		Vec<Dim>                       resultant = Vec<Dim>::Zero(); // on the soil
		Real                           work      = 0;                // in the last step that was accepted
	};

	template <int Dim> class Springs : public gimpm::Term<Dim> {
	public:
		Springs(Bed<Dim>& bed, const gimpm::StepContext<Dim>& step) : bed(bed)
		{
			for (size_t n = 0; n < step.basis.nodes.size(); ++n)
				if (gimpm::Grid<Dim>::index(step.basis.nodes[n])[1] == bed.layer) ends.push_back({ int(n), step.basis.nodes[n] });
		}
		void mark(gimpm::NodeMatrix<Dim>& K) const override
		{
			for (const End& end : ends)
				K.markUsed(end.node, 0);
		}
		std::optional<gimpm::PointFailure> add(const Eigen::VectorXd& d, const gimpm::AssembledTerms<Dim>& sum) override
		{
			for (const End& end : ends) {
				const Vec<Dim> f = force(end, d);
				sum.force.template segment<Dim>(Dim * end.node) += f;
				if (sum.absoluteContributions) sum.absoluteContributions->template segment<Dim>(Dim * end.node) += f.cwiseAbs();
				if (sum.K) sum.K->add(end.node, end.node, 0, bed.stiffness * gimpm::Mat<Dim>::Identity());
			}
			return std::nullopt;
		}
		void addBefore(Eigen::VectorXd& force) override
		{
			for (const End& end : ends)
				force.template segment<Dim>(Dim * end.node) += bed.stiffness * elongationOf(end);
		}
		double fromOutside(const Eigen::VectorXd& d) override { return this->sizeOfForce(d); }
		void   restrain(const typename gimpm::Term<Dim>::Constrain& constrain) override
		{
			for (const End& end : ends)
				for (int a = 0; a < Dim; ++a)
					constrain(end.node, Vec<Dim>::Unit(a), Vec<Dim>::Zero());
		}
		void commit(const Eigen::VectorXd& d) override
		{
			bed.work = 0, bed.resultant.setZero();
			std::map<gimpm::Key, Vec<Dim>> now;
			for (const End& end : ends) {
				const Vec<Dim> u = d.template segment<Dim>(Dim * end.node), f = force(end, d);
				bed.work -= u.dot(f + bed.stiffness * elongationOf(end)) / 2;
				bed.resultant -= f;
				now[end.key] = f / bed.stiffness;
			}
			bed.elongation.swap(now);
		}

	private:
		struct End {
			int        node;
			gimpm::Key key;
		};
		Vec<Dim> elongationOf(const End& end) const
		{
			const auto known = bed.elongation.find(end.key);
			return known == bed.elongation.end() ? Vec<Dim>(Vec<Dim>::Zero()) : known->second;
		}
		// Force by which the spring resists.
		Vec<Dim> force(const End& end, const Eigen::VectorXd& d) const
		{
			return bed.stiffness * (elongationOf(end) + d.template segment<Dim>(Dim * end.node) - bed.lift);
		}

		Bed<Dim>&   bed;
		vector<End> ends;
	};

	template <int Dim> class SpringBeds : public Condition<Dim> {
	public:
		explicit SpringBeds(const MpmCondition::Group& group)
		{
			for (const Listed& listed : group)
				given.push_back(boost::static_pointer_cast<MpmSpringBed>(listed.condition));
		}
		void join(gimpm::Model<Dim>& model, const Surroundings<Dim>&) override
		{
			for (const auto& from : given) {
				from->requireAdmissible();
				Bed<Dim> bed { from->stiffness, int(std::lround((from->height - model.grid.origin[1]) / model.grid.cellSize)) };
				for (size_t n = 0; n < from->nodes.size(); ++n)
					bed.elongation[gimpm::Grid<Dim>::key(from->nodes[n].template head<Dim>().template cast<int>())]
					        = from->elongations[n].template head<Dim>();
				beds.push_back(bed);
			}
			for (Bed<Dim>& bed : beds) {
				model.terms.push_back([&bed](const gimpm::StepContext<Dim>& step) { return std::make_unique<Springs<Dim>>(bed, step); });
				model.inPlace.push_back(
				        { [&bed](const gimpm::PointCloud<Dim>&, Real scale) { stiffen(bed, scale); }, [](const gimpm::PointCloud<Dim>&) {} });
			}
		}
		void advance(const StepTime& step, gimpm::Model<Dim>&, gimpm::Load<Dim>&) override
		{
			for (size_t i = 0; i < beds.size(); ++i) {
				const gimpm::LoadCurve curve(given[i]->curve);
				beds[i].lift = (curve.valueAt(step.looked) - curve.valueAt(step.from)) * given[i]->lift.template head<Dim>();
			}
		}
		Work work(const StepOutcome<Dim>&) const override
		{
			Work sum;
			for (const auto& bed : beds)
				sum.ofLoads += bed.work;
			return sum;
		}
		void reach(const StepOutcome<Dim>& step) override
		{
			for (size_t i = 0; i < beds.size(); ++i) {
				MpmSpringBed& to                  = *given[i];
				to.resultant.template head<Dim>() = beds[i].resultant;
				if (step.time > step.from) to.work += beds[i].work;
				to.nodes.clear(), to.elongations.clear();
				for (const auto& [key, elongation] : beds[i].elongation) {
					Vector3r node = Vector3r::Zero(), e = Vector3r::Zero();
					node.template head<Dim>() = gimpm::Grid<Dim>::index(key).template cast<Real>();
					e.template head<Dim>()    = elongation;
					to.nodes.push_back(node), to.elongations.push_back(e);
				}
			}
		}
		Penalty penalty() const override
		{
			Penalty largest { 0, "smaller MpmSpringBed.stiffness" };
			for (const auto& from : given)
				largest.size = std::max(largest.size, from->stiffness / from->young);
			return largest;
		}
		bool remembersPoints() const override { return true; }
		void share(const HalvedDomain&) const override
		{
			for (const auto& from : given)
				++from->halves;
		}

	private:
		// Stiffens the bed as a study of strength does with the soil.
		static void stiffen(Bed<Dim>& bed, Real scale)
		{
			bed.stiffness /= scale;
			for (auto& [node, elongation] : bed.elongation)
				elongation *= scale;
		}

		vector<shared_ptr<MpmSpringBed>> given;
		vector<Bed<Dim>>                 beds;
	};
}

std::shared_ptr<Condition<2>> MpmSpringBed::make(InPlane, const Group& group, const Analysis&) const { return std::make_shared<SpringBeds<2>>(group); }
std::shared_ptr<Condition<3>> MpmSpringBed::make(InSpace, const Group& group, const Analysis&) const { return std::make_shared<SpringBeds<3>>(group); }

void MpmSpringBed::tell(Rows& rows, const Analysis& analysis, const Listed& listed) const
{
	rows.setVector("springs" + std::to_string(listed.number), resultant, analysis.grid->dim);
}

// Each spring as a segment of the length of a cell below its node.
void MpmSpringBed::draw(Picture& picture, const Analysis& analysis, const Listed& listed) const
{
	for (size_t n = 0; n < nodes.size(); ++n) {
		const Vector3r place = analysis.grid->origin + analysis.grid->cellSize * nodes[n];
		const int      first = int(picture.corners.size());
		picture.corners.push_back(place);
		picture.corners.push_back(place - analysis.grid->cellSize * Vector3r::UnitY());
		picture.add({ first, first + 1 });
		picture.set("elongation", elongations[n]);
		picture.set("load", int(listed.number));
	}
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmSpringBed)
static const yade::PluginClasses<yade::MpmSpringBed> registeredMpmSpringBed(__FILE__);
