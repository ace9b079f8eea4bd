// SPDX-License-Identifier: GPL-3.0-or-later
// Simbody 3.7 (Debian) on the problems of the comparison. Not part of the product.
//
// peer_simbody sixbar    integrators over accuracies, and settings of the best ones
// peer_simbody rhs       one right-hand side: six-bar, and windows over N
// peer_simbody windows   N four-bar windows, 10 s: error of B0
// Further arguments: measure.h.
//
// Planar bodies carry a spherical inertia: with Izz = Ixx + Iyy exactly, Simbody's check of the
// triangle inequality stops a run at round-off. No -DNDEBUG: Debian's library is built without it
// and the layout of its classes differs.
#include "../measure.h"
#include "Simbody.h"
#include <array>
#include <memory>
#include <string>
#include <vector>
using namespace SimTK;

// torsion spring and damper between a body and the ground, for a hinge where the loop is cut
class GroundTorsion : public Force::Custom::Implementation {
  public:
    GroundTorsion(const SimbodyMatterSubsystem &m, std::vector<MobilizedBody> chain_, Real k_,
                  Real c_)
        : matter(m), chain(std::move(chain_)), k(k_), c(c_) {}
    void calcForce(const State &s, Vector_<SpatialVec> &bodyForces, Vector_<Vec3> &,
                   Vector &) const override {
        Real angle = 0, rate = 0;
        for (const MobilizedBody &b : chain) {
            angle += b.getOneQ(s, 0);
            rate += b.getOneU(s, 0);
        }
        bodyForces[chain.back().getMobilizedBodyIndex()][0] += Vec3(0, 0, -k * angle - c * rate);
    }
    Real calcPotentialEnergy(const State &s) const override {
        Real angle = 0;
        for (const MobilizedBody &b : chain)
            angle += b.getOneQ(s, 0);
        return k * angle * angle / 2;
    }

  private:
    const SimbodyMatterSubsystem &matter;
    std::vector<MobilizedBody> chain;
    Real k, c;
};

// torsion spring and damper between the last bodies of two branches, where the loop is cut
class BranchTorsion : public Force::Custom::Implementation {
  public:
    BranchTorsion(std::vector<MobilizedBody> left_, std::vector<MobilizedBody> right_, Real k_,
                  Real c_)
        : left(std::move(left_)), right(std::move(right_)), k(k_), c(c_) {}
    void calcForce(const State &s, Vector_<SpatialVec> &bodyForces, Vector_<Vec3> &,
                   Vector &) const override {
        Real angle = 0, rate = 0;
        for (const MobilizedBody &b : right)
            angle += b.getOneQ(s, 0), rate += b.getOneU(s, 0);
        for (const MobilizedBody &b : left)
            angle -= b.getOneQ(s, 0), rate -= b.getOneU(s, 0);
        const Vec3 torque(0, 0, -k * angle - c * rate);
        bodyForces[right.back().getMobilizedBodyIndex()][0] += torque;
        bodyForces[left.back().getMobilizedBodyIndex()][0] -= torque;
    }
    Real calcPotentialEnergy(const State &) const override { return 0; }

  private:
    std::vector<MobilizedBody> left, right;
    Real k, c;
};

static Body::Rigid planar(double mass, double inertia) {
    return Body::Rigid(MassProperties(mass, Vec3(0), Inertia(inertia, inertia, inertia)));
}

struct SixBar {
    MultibodySystem system;
    SimbodyMatterSubsystem matter;
    GeneralForceSubsystem forces;
    std::array<MobilizedBody, 5> body;

    static Vec3 local(int b, int hinge) {
        return Vec3(six_hinge[hinge][0] - six_centre[b][0], six_hinge[hinge][1] - six_centre[b][1],
                    0);
    }
    // the loop is cut at hinge F (a chain of five) or at D (branches of three and two)
    explicit SixBar(bool cut_at_D) : matter(system), forces(system) {
        const int last = cut_at_D ? 3 : 5; // bodies of the first branch
        for (int b = 0; b < last; b++)
            hang(b, b ? body[b - 1] : MobilizedBody(matter.Ground()), b ? local(b - 1, b) : at(0),
                 b);
        for (int b = 4; b >= last; b--)
            hang(b, b < 4 ? body[b + 1] : MobilizedBody(matter.Ground()),
                 b < 4 ? local(b + 1, b + 1) : at(5), b + 1);
        if (cut_at_D) {
            close(body[2], local(2, 3), body[3], local(3, 3));
            Force::Custom(forces, new BranchTorsion({body[0], body[1], body[2]}, {body[4], body[3]},
                                                    six_stiffness[3], six_damping[3]));
        } else {
            close(matter.Ground(), at(5), body[4], local(4, 5));
            Force::Custom(forces, new GroundTorsion(matter, {body.begin(), body.end()},
                                                    six_stiffness[5], six_damping[5]));
        }
        Force::ConstantForce(forces, body[2], Vec3(0), Vec3(six_force[0], six_force[1], 0));
        Force::ConstantTorque(forces, body[0], Vec3(0, 0, six_torque));
        system.realizeTopology();
    }
    void coordinates(const State &s, double q[15]) const {
        for (int b = 0; b < 5; b++) {
            const Transform &x = body[b].getBodyTransform(s);
            q[3 * b] = x.p()[0];
            q[3 * b + 1] = x.p()[1];
            q[3 * b + 2] = std::atan2(x.R()[1][0], x.R()[0][0]);
        }
    }

  private:
    static Vec3 at(int hinge) { return Vec3(six_hinge[hinge][0], six_hinge[hinge][1], 0); }
    void hang(int b, MobilizedBody parent, Vec3 there, int hinge) {
        body[b] = MobilizedBody::Pin(parent, Transform(there), planar(six_mass[b], six_inertia[b]),
                                     Transform(local(b, hinge)));
        Force::MobilityLinearSpring(forces, body[b], MobilizerQIndex(0), six_stiffness[hinge], 0);
        Force::MobilityLinearDamper(forces, body[b], MobilizerUIndex(0), six_damping[hinge]);
    }
    void close(MobilizedBody a, Vec3 on_a, MobilizedBody b, Vec3 on_b) {
        Constraint::PointInPlane(a, UnitVec3(1, 0, 0), on_a[0], b, on_b);
        Constraint::PointInPlane(a, UnitVec3(0, 1, 0), on_a[1], b, on_b);
    }
};

struct Windows { // cranks on the ground, every coupler on its left crank, cut at its right one
    MultibodySystem system;
    SimbodyMatterSubsystem matter;
    GeneralForceSubsystem forces;
    std::vector<MobilizedBody> crank, coupler;

    explicit Windows(int n) : matter(system), forces(system) {
        Force::UniformGravity(forces, matter, Vec3(0, -9.81, 0));
        for (int i = 0; i <= n; i++)
            crank.push_back(MobilizedBody::Pin(matter.Ground(), Transform(Vec3(i, 0, 0)),
                                               planar(1, 1. / 12), Transform(Vec3(0, -.5, 0))));
        for (int i = 1; i <= n; i++) {
            MobilizedBody::Pin b(crank[i - 1], Transform(Vec3(0, .5, 0)), planar(1, 1. / 12),
                                 Transform(Vec3(-.5, 0, 0)));
            coupler.push_back(b);
            Constraint::PointInPlane(crank[i], UnitVec3(1, 0, 0), 0, b, Vec3(.5, 0, 0));
            Constraint::PointInPlane(crank[i], UnitVec3(0, 1, 0), .5, b, Vec3(.5, 0, 0));
        }
        system.realizeTopology();
    }
    State start() const {
        State s = system.getDefaultState();
        for (const MobilizedBody &b : crank)
            b.setOneU(s, 0, -1);
        for (const MobilizedBody &b : coupler)
            b.setOneU(s, 0, 1);
        return s;
    }
    void b0(const State &s, double out[4]) const {
        const Vec3 p = crank[0].findStationLocationInGround(s, Vec3(0, .5, 0));
        const Vec3 v = crank[0].findStationVelocityInGround(s, Vec3(0, .5, 0));
        out[0] = p[0], out[1] = p[1], out[2] = v[0], out[3] = v[1];
    }
};

enum Kind { MERSON, FEHLBERG, RK3, RK2, VERLET, BDF_NEWTON, BDF_FUNCTIONAL, ADAMS, EULER2 };
static const char *const kind_name[] = {"RungeKuttaMerson",
                                        "RungeKuttaFeldberg",
                                        "RungeKutta3",
                                        "RungeKutta2",
                                        "Verlet",
                                        "CPodes BDF Newton",
                                        "CPodes BDF functional",
                                        "CPodes Adams functional",
                                        "SemiExplicitEuler2"};

static Integrator *integrator(Kind kind, const System &s) {
    switch (kind) {
    case MERSON:
        return new RungeKuttaMersonIntegrator(s);
    case FEHLBERG:
        return new RungeKuttaFeldbergIntegrator(s);
    case RK3:
        return new RungeKutta3Integrator(s);
    case RK2:
        return new RungeKutta2Integrator(s);
    case VERLET:
        return new VerletIntegrator(s);
    case BDF_NEWTON:
        return new CPodesIntegrator(s, CPodes::BDF, CPodes::Newton);
    case BDF_FUNCTIONAL:
        return new CPodesIntegrator(s, CPodes::BDF, CPodes::Functional);
    case ADAMS:
        return new CPodesIntegrator(s, CPodes::Adams, CPodes::Functional);
    default:
        return new SemiExplicitEuler2Integrator(s);
    }
}

struct Options {
    Kind kind = MERSON;
    double accuracy = 1e-3,
           tolerance = 0; // of the constraints; 0: Simbody's own, a tenth of accuracy
    bool every_step = false, full_newton = false, infinity_norm = false;
    bool cut_at_D = false;
    double budget_s = 60;
    int windows = 0;
    const six_reference *reference = nullptr;
};

static void apply(Integrator &i, const Options &o) {
    i.setAccuracy(o.accuracy);
    if (o.tolerance > 0) i.setConstraintTolerance(o.tolerance);
    if (o.every_step) i.setProjectEveryStep(true);
    if (o.full_newton) i.setForceFullNewton(true);
    if (o.infinity_norm) i.setUseInfinityNorm(true);
    i.setInternalStepLimit(2000000000);
}

static std::string reason;

static std::string first_line(const std::string &text) {
    return text.substr(0, text.find('\n'));
}

static outcome six_run(void *context) {
    const Options &o = *static_cast<Options *>(context);
    static std::unique_ptr<SixBar> model[2];
    auto &m = model[o.cut_at_D];
    if (!m) m.reset(new SixBar(o.cut_at_D));
    outcome out = {0, 0, 0, nullptr};
    double began = cpu_seconds();
    try {
        std::unique_ptr<Integrator> i(integrator(o.kind, m->system));
        apply(*i, o);
        TimeStepper stepper(m->system, *i);
        began = cpu_seconds();
        stepper.initialize(m->system.getDefaultState());
        for (int k = 1; k <= 10; k++) {
            stepper.stepTo(k);
            double q[15];
            m->system.realize(stepper.getState(), Stage::Position);
            m->coordinates(stepper.getState(), q);
            const double e = six_error(o.reference, k, q);
            if (!(e <= out.error)) out.error = e;
        }
        out.rhs = i->getNumRealizations();
    } catch (const std::exception &e) {
        reason = first_line(e.what());
        out.failed = reason.c_str();
    }
    out.cpu_s = cpu_seconds() - began;
    return out;
}

// from the loosest accuracy on until a run takes longer than the budget
static void curve(const request &wish, Options o, const std::string &setting, int first, int last,
                  outcome (*run)(void *)) {
    for (int e = first; e <= last; e++) {
        if (!wanted(&wish, setting.c_str(), e)) continue;
        o.accuracy = std::pow(10., -e);
        const outcome out = measure(run, &o);
        print_row("Simbody", setting.c_str(), o.accuracy, out);
        if (out.cpu_s > o.budget_s) break;
    }
}

static void six_bar(const request &wish) {
    six_reference reference;
    six_read(wish.reference, &reference);
    Options o;
    o.reference = &reference;
    o.budget_s = wish.quick ? .2 : 1;
    for (int kind = MERSON; kind <= EULER2; kind++) {
        o.kind = Kind(kind);
        const bool best = kind == MERSON || kind == FEHLBERG || kind == BDF_NEWTON;
        if (wish.quick && !best) continue;
        for (int cut = 0; cut < (best ? 2 : 1); cut++) {
            o.cut_at_D = cut;
            const std::string name = kind_name[kind] + std::string(cut ? " cut at D" : "");
            curve(wish, o, name, 3, 12, six_run);
            if (!cut) continue;
            o.every_step = true;
            curve(wish, o, name + " project every step", 3, 12, six_run);
            o.every_step = false;
            o.infinity_norm = true;
            curve(wish, o, name + " infinity norm", 3, 12, six_run);
            o.infinity_norm = false;
        }
    }
}

static outcome window_run(void *context) {
    const Options &o = *static_cast<Options *>(context);
    outcome out = {0, 0, 0, nullptr};
    const Windows m(o.windows);
    const double began = cpu_seconds();
    try {
        std::unique_ptr<Integrator> i(integrator(o.kind, m.system));
        apply(*i, o);
        TimeStepper stepper(m.system, *i);
        stepper.initialize(m.start());
        for (int k = 1; k <= 40; k++) { // in pieces, so that the budget can end it
            stepper.stepTo(k * .25);
            if (cpu_seconds() - began > o.budget_s) {
                out.failed = "takes longer than the budget";
                break;
            }
        }
        double b0[4];
        m.system.realize(stepper.getState(), Stage::Velocity);
        m.b0(stepper.getState(), b0);
        out.error = windows_error(o.windows, b0);
        out.rhs = i->getNumRealizations();
    } catch (const std::exception &e) {
        reason = first_line(e.what());
        out.failed = reason.c_str();
    }
    out.cpu_s = cpu_seconds() - began;
    return out;
}

// Simbody's own choice of when to project, and the cure: every step, full Newton, to round-off
static void windows(const request &wish) {
    const int sizes[] = {1, 2, 10, 40, 100};
    for (int n : sizes) {
        if (wish.quick && n > 10) break;
        Options o;
        o.windows = n;
        o.budget_s = n > 40 ? 60 : 25;
        const std::string name = "N=" + std::to_string(n);
        curve(wish, o, name, 4, n > 10 ? 6 : 9, window_run);
        o.every_step = o.full_newton = true;
        o.tolerance = n > 40 ? 1e-9 : 1e-10;
        curve(wish, o, name + " project every step", n > 10 ? 6 : 4,
              n > 40   ? 6
              : n > 10 ? 8
                       : 9,
              window_run);
        o.kind = BDF_NEWTON;
        if (n <= 10)
            curve(wish, o, name + " project every step CPodes BDF Newton", 4, 9, window_run);
    }
}

static outcome rhs_run(const MultibodySystem &system, State s) {
    enum { REPEATS = 200 };
    const double began = cpu_seconds();
    int done = 0;
    while (done < REPEATS && (done < 3 || cpu_seconds() - began < .3)) {
        s.updTime() += 0; // a new time, position and velocity: nothing is reused
        s.updQ();
        s.updU();
        system.realize(s, Stage::Acceleration);
        done++;
    }
    return {0, (cpu_seconds() - began) / done, 1, nullptr};
}

static void right_hand_side(const request &wish) {
    for (int cut = 0; cut < 2; cut++) {
        const SixBar m(cut);
        State s = m.system.getDefaultState();
        m.system.realize(s, Stage::Acceleration);
        rhs_run(m.system, s);
        double cpu[31];
        outcome o = {0, 0, 0, nullptr};
        for (double &c : cpu)
            o = rhs_run(m.system, s), c = o.cpu_s;
        qsort(cpu, 31, sizeof *cpu, by_size);
        o.cpu_s = cpu[15];
        print_row("Simbody", cut ? "six-bar cut at D" : "six-bar", 0, o);
    }
    const int sizes[] = {1, 2, 10, 40, 100, 300, 1000};
    for (int n : sizes) {
        if (n > (wish.quick ? 100 : 1000)) break;
        const Windows m(n);
        State s = m.start();
        m.system.realize(s, Stage::Acceleration);
        print_row("Simbody", ("N=" + std::to_string(n)).c_str(), 0, rhs_run(m.system, s));
    }
}

int main(int argc, char **argv) {
    const request wish = read_request(argc, argv);
    const std::string what = wish.problem;
    if (what == "sixbar")
        six_bar(wish);
    else if (what == "windows")
        windows(wish);
    else if (what == "rhs")
        right_hand_side(wish);
    else
        return 2;
    return 0;
}
