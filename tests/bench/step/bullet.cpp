// Bullet: btSoftBody in a btSoftRigidDynamicsWorld, built of the same particles, springs and faces.

#include <BulletSoftBody/btDefaultSoftBodySolver.h>
#include <BulletSoftBody/btSoftBodyInternals.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>

#include "softbody/contact/keys.h"
#include "softbody/forces/gas.h"
#include "softbody/forces/springs.h"
#include "tests/bench/step/stepper.h"

namespace bench {
namespace {

using softbody::BodyId;

btVector3 vector(const glm::dvec3& v) { return {btScalar(v.x), btScalar(v.y), btScalar(v.z)}; }
glm::dvec3 vector(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

enum class SoftContact { vertex_face, clusters };

/// Lets clusters touch those of their own body too. The flags for it, CL_SS | CL_SELF, switch off both kinds of contact
/// in Bullet 3.24, whose handler does not know their sum; this does at the same place what it would do.
class SelfContact final : public btDefaultSoftBodySolver {
 public:
  void solveConstraints(btScalar seconds) override {
    btDefaultSoftBodySolver::solveConstraints(seconds);
    for (int i = 0; i < m_softBodySet.size(); ++i) {
      btSoftColliders::CollideCL_SS self;
      self.ProcessSoftSoft(m_softBodySet[i], m_softBodySet[i]);
    }
  }
};

/// The part of a spring's deviation that kLST has to take away in a step of h seconds for a stiffness of k N/m: what an
/// implicit step takes away of that of a lone spring between particles of mass m.
btScalar linear_stiffness(double k, double m, double h) {
  const double pull = 2 / m * k * h * h;
  return btScalar(pull / (1 + pull));
}

class Bullet final : public Stepper {
 public:
  Bullet(const softbody::Scene& scene, int steps, SoftContact contact)
      : steps_(steps),
        h_(1.0 / frames_a_second / steps),
        contact_(contact),
        mirror_(scene, {}),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_,
               contact == SoftContact::clusters ? &self_contact_ : nullptr) {
    world_.setGravity(vector(scene.gravity));
    world_.getWorldInfo().m_gravity = vector(scene.gravity);
    add_solids(scene);
    for (BodyId b = 0; b < mirror_.bodies().count(); ++b) add_body(b);
  }
  ~Bullet() override {
    for (const auto& body : soft_) world_.removeSoftBody(body.get());
    for (const auto& solid : solids_) world_.removeRigidBody(solid.body.get());
  }

  void step() override {
    for (int i = 0; i < steps_; ++i) world_.stepSimulation(btScalar(h_), 0);
  }

  bool finite() const override {
    for (const auto& body : soft_)
      for (int i = 0; i < body->m_nodes.size(); ++i)
        for (const btVector3& v : {body->m_nodes[i].m_x, body->m_nodes[i].m_v})
          if (!std::isfinite(v.x()) || !std::isfinite(v.y()) || !std::isfinite(v.z())) return false;
    return true;
  }

  const softbody::World& state() override {
    std::vector<softbody::Particle> particles;
    for (BodyId b = 0; b < soft_.size(); ++b) {
      particles.clear();
      for (int i = 0; i < soft_[b]->m_nodes.size(); ++i)
        particles.push_back({vector(soft_[b]->m_nodes[i].m_x), vector(soft_[b]->m_nodes[i].m_v)});
      mirror_.set_particles(b, particles);
    }
    return mirror_;
  }

 private:
  struct Solid {
    std::unique_ptr<btCollisionShape> shape;
    std::unique_ptr<btRigidBody> body;
  };

  void add_solid(std::unique_ptr<btCollisionShape> shape, const btVector3& centre, double friction) {
    auto body = std::make_unique<btRigidBody>(0, nullptr, shape.get());
    body->setWorldTransform(btTransform(btQuaternion::getIdentity(), centre));
    // Bullet multiplies it by the soft body's.
    body->setFriction(btScalar(friction / mirror_.model(0).material[softbody::contact::friction]));
    world_.addRigidBody(body.get());
    solids_.push_back({std::move(shape), std::move(body)});
  }

  void add_solids(const softbody::Scene& scene) {
    // Soft bodies find their distance to convex shapes only, which Bullet's plane is none of.
    constexpr btScalar side = 100, thickness = 10;  // m, half of it
    for (const softbody::Solid& solid : scene.solids) {
      if (const auto* s = std::get_if<softbody::SolidSphere>(&solid.shape))
        add_solid(std::make_unique<btSphereShape>(btScalar(s->radius)), vector(s->centre), solid.friction);
      if (const auto* ground = std::get_if<softbody::Ground>(&solid.shape))
        add_solid(std::make_unique<btBoxShape>(btVector3(side, thickness, side)),
                  btVector3(0, btScalar(ground->height) - thickness, 0), solid.friction);
    }
  }

  void add_links(btSoftBody& body, const std::vector<softbody::Spring>& springs, double particle_mass) {
    if (springs.empty()) return;
    btSoftBody::Material* material = body.appendMaterial();
    material->m_kLST = linear_stiffness(springs.front().stiffness, particle_mass, h_);
    for (const softbody::Spring& s : springs) body.appendLink(int(s.i), int(s.j), material);
  }

  void add_body(BodyId b) {
    const softbody::BodyModel& model = mirror_.model(b);
    std::vector<btVector3> x;
    for (const glm::dvec3& v : model.start) x.push_back(vector(mirror_.scene().bodies[b].position + v));
    const std::vector<btScalar> mass(x.size(), btScalar(model.particle_mass));
    auto body = std::make_unique<btSoftBody>(&world_.getWorldInfo(), int(x.size()), x.data(), mass.data());
    add_links(*body, softbody::springs<softbody::StructuralSprings>(model), model.particle_mass);
    add_links(*body, softbody::springs<softbody::BendSprings>(model), model.particle_mass);
    for (const softbody::Triangle& t : model.mesh.triangles) body->appendFace(int(t[0]), int(t[1]), int(t[2]));
    soft_.push_back(std::move(body));
    configure(*soft_.back(), model);
    world_.addSoftBody(soft_.back().get());
  }

  void configure(btSoftBody& body, const softbody::BodyModel& model) {
    constexpr btScalar margin = 0.02;  // m; two of them fit between bodies at the start
    constexpr int clusters = 16;
    body.getCollisionShape()->setMargin(margin);
    body.m_cfg.kDF = btScalar(model.material[softbody::contact::friction]);
    body.m_cfg.kKHR = 1;  // with the default, 0.1, vertices sink 0.2 R into the solids
    if (const auto* gas = softbody::gas_of(model))
      body.m_cfg.kPR = btScalar(gas->amount - gas->ambient * model.start_volume);  // right at the start's volume
    body.m_cfg.collisions = btSoftBody::fCollision::SDF_RS;
    body.m_cfg.collisions |=
        contact_ == SoftContact::clusters ? btSoftBody::fCollision::CL_SS : btSoftBody::fCollision::VF_SS;
    if (contact_ == SoftContact::clusters) body.generateClusters(clusters);
    // What the first step would do, but for resting lengths other than those at the start, and for each particle's
    // share of the faces' areas, of which Bullet takes the mean instead of a third of the sum.
    body.updateConstants();
    body.updateArea(false);
    int i = 0;
    for (const auto* springs :
         {&softbody::springs<softbody::StructuralSprings>(model), &softbody::springs<softbody::BendSprings>(model)})
      for (const softbody::Spring& s : *springs) {
        body.m_links[i].m_rl = btScalar(s.rest);
        body.m_links[i].m_c1 = btScalar(s.rest * s.rest);
        ++i;
      }
    if (contact_ == SoftContact::vertex_face) body.initializeFaceTree();
    body.updateNormals();
    body.m_bUpdateRtCst = false;
  }

  int steps_;
  double h_;
  SoftContact contact_;
  softbody::World mirror_;  // the same bodies; shows where Bullet's are, so that all are judged alike
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  SelfContact self_contact_;
  btSoftRigidDynamicsWorld world_;
  std::vector<Solid> solids_;
  std::vector<std::unique_ptr<btSoftBody>> soft_;
};

}  // namespace

std::unique_ptr<Stepper> make_bullet_vertex_face(const softbody::Scene& scene, int steps) {
  return std::make_unique<Bullet>(scene, steps, SoftContact::vertex_face);
}
std::unique_ptr<Stepper> make_bullet_clusters(const softbody::Scene& scene, int steps) {
  return std::make_unique<Bullet>(scene, steps, SoftContact::clusters);
}

}  // namespace bench
