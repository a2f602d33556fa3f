// This program steps the five-bar with Pinocchio's constrained dynamics: two open chains whose tips a 3D constraint keeps together.
//
// Arguments: rig file, force file, scheme (euler or rk4), steps a tick, rate of Baumgarte's stabilisation (1/s), timed runs, file for the
// run. Prints the CPU time of a step, ns: the median and the least of the timed runs.
//
// Rig file, numbers only: step, distance of the base joints; length, mass, inertia, centre of mass of AE, ED, BC, CD; angles of A, E, B, C at the
// start. Force file: x and y, a line a tick.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

#include <pinocchio/fwd.hpp>
#include <pinocchio/algorithm/constrained-dynamics.hpp>
#include <pinocchio/multibody.hpp>
#include <pinocchio/multibody/joint.hpp>

namespace pin = pinocchio;
using Four = Eigen::Vector4d;
using Two = Eigen::Vector2d;

struct Arm {
  double length, mass, inertia, centre;
};

struct Rig {
  double step, base;
  Arm ae, ed, bc, cd;
  double a, e, b, c;
};

static Rig read_rig(const std::string &path) {
  std::ifstream file(path);
  Rig rig;
  file >> rig.step >> rig.base;
  for (Arm *arm : {&rig.ae, &rig.ed, &rig.bc, &rig.cd})
    file >> arm->length >> arm->mass >> arm->inertia >> arm->centre;
  file >> rig.a >> rig.e >> rig.b >> rig.c;
  if (!file) {
    std::cerr << path << ": a number is missing\n";
    std::exit(3);
  }
  return rig;
}

static std::vector<Two> read_forces(const std::string &path) {
  std::ifstream file(path);
  std::vector<Two> forces;
  double x, y;
  while (file >> x >> y) forces.emplace_back(x, y);
  return forces;
}

// The rig as a tree of four revolute joints in the order A, E, B, C, and the constraint that closes it.
struct Linkage {
  Rig rig;
  pin::Model model;
  pin::Data data;
  std::vector<pin::RigidConstraintModel> constraints;
  std::vector<pin::RigidConstraintData> constraint_data;
  // The third row of the constraint is empty in the plane: the proximal term makes it solvable.
  pin::ProximalSettings settings{1e-12, 1e-10, 10};

  Linkage(const Rig &of, double rate) : rig(of) {
    const auto e = add(add(0, -0.5 * rig.base, rig.ae), rig.ae.length, rig.ed);
    const auto c = add(add(0, 0.5 * rig.base, rig.bc), rig.bc.length, rig.cd);
    data = pin::Data(model);
    const auto at = [](double x) { return pin::SE3(Eigen::Matrix3d::Identity(), Eigen::Vector3d(x, 0, 0)); };
    constraints.emplace_back(pin::CONTACT_3D, model, e, at(rig.ed.length), c, at(rig.cd.length), pin::LOCAL);
    constraints[0].baumgarte_corrector_parameters().Kp = rate * rate;
    constraints[0].baumgarte_corrector_parameters().Kd = 2 * rate;
    constraint_data.emplace_back(constraints[0]);
    pin::initConstraintDynamics(model, data, constraints, constraint_data);
  }

  pin::JointIndex add(pin::JointIndex parent, double x, const Arm &arm) {
    const pin::SE3 place(Eigen::Matrix3d::Identity(), Eigen::Vector3d(x, 0, 0));
    const auto joint = model.addJoint(parent, pin::JointModelRZ(), place, "joint" + std::to_string(model.njoints));
    const Eigen::Matrix3d inertia = arm.inertia * Eigen::Matrix3d::Identity();
    const pin::Inertia body(arm.mass, Eigen::Vector3d(arm.centre, 0, 0), inertia);
    model.appendBodyToJoint(joint, body, pin::SE3::Identity());
    return joint;
  }

  Two left(const Four &q) const {
    return Two(-0.5 * rig.base, 0) + rig.ae.length * Two(std::cos(q[0]), std::sin(q[0])) +
           rig.ed.length * Two(std::cos(q[0] + q[1]), std::sin(q[0] + q[1]));
  }

  Two right(const Four &q) const {
    return Two(0.5 * rig.base, 0) + rig.bc.length * Two(std::cos(q[2]), std::sin(q[2])) +
           rig.cd.length * Two(std::cos(q[2] + q[3]), std::sin(q[2] + q[3]));
  }

  // The force acts on the tip of arm ED.
  Four acceleration(const Four &q, const Four &v, const Two &force) {
    const Two ed = rig.ed.length * Two(std::cos(q[0] + q[1]), std::sin(q[0] + q[1]));
    const Two ad = rig.ae.length * Two(std::cos(q[0]), std::sin(q[0])) + ed;
    const Four tau(ad.x() * force.y() - ad.y() * force.x(), ed.x() * force.y() - ed.y() * force.x(), 0, 0);
    return pin::constraintDynamics(model, data, q, v, tau, constraints, constraint_data, settings);
  }
};

static void euler(Linkage &linkage, Four &q, Four &v, const Two &force, double h) {
  v += h * linkage.acceleration(q, v, force);
  q += h * v;
}

static void rk4(Linkage &linkage, Four &q, Four &v, const Two &force, double h) {
  const Four a1 = linkage.acceleration(q, v, force);
  const Four v2 = v + 0.5 * h * a1;
  const Four a2 = linkage.acceleration(q + 0.5 * h * v, v2, force);
  const Four v3 = v + 0.5 * h * a2;
  const Four a3 = linkage.acceleration(q + 0.5 * h * v2, v3, force);
  const Four v4 = v + h * a3;
  const Four a4 = linkage.acceleration(q + h * v3, v4, force);
  q += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
  v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
}

// The run, a state a tick.
static std::vector<Four> run(Linkage &linkage, const std::vector<Two> &forces, bool fourth_order, int steps) {
  Four q(linkage.rig.a, linkage.rig.e, linkage.rig.b, linkage.rig.c), v = Four::Zero();
  std::vector<Four> states{q};
  states.reserve(forces.size() + 1);
  const double h = linkage.rig.step / steps;
  for (const Two &force : forces) {
    for (int i = 0; i < steps; ++i) fourth_order ? rk4(linkage, q, v, force, h) : euler(linkage, q, v, force, h);
    states.push_back(q);
  }
  return states;
}

static double cpu_ns() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e9 * now.tv_sec + now.tv_nsec;
}

int main(int argc, char **argv) {
  if (argc != 8) {
    std::cerr << "arguments: rig forces euler|rk4 steps rate runs out\n";
    return 2;
  }
  const auto forces = read_forces(argv[2]);
  const bool fourth_order = std::string(argv[3]) == "rk4";
  const int steps = std::atoi(argv[4]), runs = std::atoi(argv[6]);
  Linkage linkage(read_rig(argv[1]), std::atof(argv[5]));
  const auto states = run(linkage, forces, fourth_order, steps);
  std::ofstream out(argv[7]);
  out << "left_x_m,left_y_m,right_x_m,right_y_m\n" << std::setprecision(17);
  for (const Four &q : states) {
    const Two left = linkage.left(q), right = linkage.right(q);
    out << left.x() << ',' << left.y() << ',' << right.x() << ',' << right.y() << '\n';
  }
  std::vector<double> each;
  for (int i = 0; i < runs; ++i) {
    const double start = cpu_ns();
    run(linkage, forces, fourth_order, steps);
    each.push_back((cpu_ns() - start) / (double(forces.size()) * steps));
  }
  std::sort(each.begin(), each.end());
  if (!each.empty()) std::cout << each[each.size() / 2] << ' ' << each[0] << '\n';
}
