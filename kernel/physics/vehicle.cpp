#include "kernel/physics/vehicle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "kernel/drill/nudge.h"
#include "kernel/physics/bullet/box_gap.h"
#include "kernel/physics/bullet/bullet.h"
#include "kernel/physics/ground.h"
#include "kernel/physics/tyres.h"
#include "world/frames.h"

namespace reprise::kernel {

namespace {

// Springs. The dampers are softer in compression than in rebound, as real ones are.
constexpr double compression_damping = 0.35;  // share of critical damping
constexpr double rebound_damping = 0.45;
constexpr double wheel_travel = 0.25;     // [m] from rest up to the stop
constexpr double anti_roll_share = 0.55;  // of the springs' roll stiffness

double wrap_turn(double angle) {
    const double turn = 2 * std::numbers::pi;
    const double wrapped = angle - turn * std::floor(angle / turn);
    return wrapped < turn ? wrapped : 0;
}

}  // namespace

struct Vehicle::Chassis {
    Chassis(const world::CarModel& model, btDynamicsWorld& bullet, const Ground& ground);

    ~Chassis() { world->removeRigidBody(&body); }

    void hang_wheels(const world::CarModel& model);

    btDynamicsWorld* world;
    btBoxShape box;
    btCompoundShape shape;
    btRigidBody body;
    WheelRays rays;
    RaycastCar car;
};

namespace {

btRigidBody::btRigidBodyConstructionInfo chassis_info(const world::CarModel& model,
                                                      btCollisionShape& shape) {
    btRigidBody::btRigidBodyConstructionInfo info(
        model.catalogue->mass, nullptr, &shape, to_bullet(model.inertia));
    // Sheet metal: little bounce (0.3 * 0.3), sliding friction 0.36 of two bodies.
    info.m_friction = 0.6;
    info.m_restitution = 0.3;
    return info;
}

}  // namespace

Vehicle::Chassis::Chassis(const world::CarModel& model,
                          btDynamicsWorld& bullet,
                          const Ground& ground)
    : world(&bullet),
      box(to_bullet(model.box_half)),
      shape(false),
      body((shape.addChildShape(
                btTransform(btQuaternion::getIdentity(), to_bullet(model.box_centre)), &box),
            chassis_info(model, shape))),
      rays(ground),
      car(&body, rays) {
    body.setActivationState(DISABLE_DEACTIVATION);
    hang_wheels(model);
}

void Vehicle::Chassis::hang_wheels(const world::CarModel& model) {
    const world::VehicleModel& m = *model.catalogue;
    const double omega = model.spring_frequency;
    const double sag = world::gravity / (omega * omega);  // of the springs under the car's weight
    const double height = m.wheel_radius + wheel_travel - model.com_height;
    for (int i = 0; i < 4; ++i) {
        const bool front = i < 2;
        const bool left = i % 2 == 0;
        const double x = (front ? m.wheelbase : 0) - model.com_ahead;
        const double share = (front ? model.front_share : 1 - model.front_share) / 2;
        btWheelInfo& wheel = car.addWheel(btVector3(x, (left ? 0.5 : -0.5) * model.track, height),
                                          btVector3(0, 0, -1),
                                          btVector3(0, -1, 0),
                                          wheel_travel + sag,
                                          m.wheel_radius,
                                          btRaycastVehicle::btVehicleTuning(),
                                          front);
        // Bullet's unit for these: per mass of the whole car.
        wheel.m_suspensionStiffness = share * omega * omega;
        wheel.m_wheelsDampingCompression = 2 * compression_damping * omega * share;
        wheel.m_wheelsDampingRelaxation = 2 * rebound_damping * omega * share;
        wheel.m_maxSuspensionTravelCm = 100 * (wheel_travel + sag);
        wheel.m_maxSuspensionForce = 6 * share * m.mass * world::gravity;
        wheel.m_wheelsSuspensionForce = 0;
        wheel.m_skidInfo = 1;
        const auto index = static_cast<std::size_t>(i);
        car.wheels[index].cornering_stiffness =
            front ? world::front_cornering : world::rear_cornering;
        car.anti_roll[index / 2] = anti_roll_share * share * omega * omega * m.mass / 2;
    }
    car.gravity = world::gravity;
    car.rolling_resistance = model.rolling_resistance;
    car.resetSuspension();
}

Vehicle::Vehicle(std::uint32_t id,
                 std::uint16_t model,
                 btDynamicsWorld& bullet,
                 const Ground& ground,
                 const Eigen::Isometry3d& pose_world_vehicle,
                 double speed,
                 Balance balance)
    : id_(id),
      model_index_(model),
      model_(balance == Balance::kept ? world::car_model(world::vehicle_models()[model])
                                      : world::unbalanced_model(world::vehicle_models()[model])),
      ground_(&ground),
      driveline_(model_.powertrain, speed) {
    put_down(bullet, pose_world_vehicle, speed);
}

/// A new chassis there: at rest on its wheels.
void Vehicle::put_down(btDynamicsWorld& bullet,
                       const Eigen::Isometry3d& pose_world_vehicle,
                       double speed) {
    lies_still_ = 0;
    ++times_put_down_;
    chassis_.reset();  // Bullet hears of the old one's end first
    chassis_ = std::make_unique<Chassis>(model_, bullet, *ground_);
    const Eigen::Isometry3d pose_world_body =
        pose_world_vehicle * Eigen::Translation3d(model_.com_ahead, 0, model_.com_height);
    const Eigen::Vector3d velocity = pose_world_vehicle.linear().col(0) * speed;
    btRigidBody& body = chassis_->body;
    body.setCenterOfMassTransform(to_bullet(pose_world_body));
    body.setInterpolationWorldTransform(body.getCenterOfMassTransform());
    body.setLinearVelocity(to_bullet(velocity));
    tag(body, vehicle_body, id_);
    tag_mass(body, model_.catalogue->mass);
    bullet.addRigidBody(&body);
    last_position_ = world::to_vec3(pose_world_vehicle.translation());
    last_velocity_ = world::to_vec3(velocity);
}

Vehicle::~Vehicle() = default;

btRigidBody& Vehicle::body() const {
    return chassis_->body;
}

PlacedBox Vehicle::box() const {
    const btTransform& pose = body().getCenterOfMassTransform();
    return {btTransform(pose.getBasis(), pose(to_bullet(model_.box_centre))),
            to_bullet(model_.box_half)};
}

void Vehicle::set_control(const world::Control& control) {
    control_ = control;
}

void Vehicle::steer(double step) {
    const world::VehicleModel& m = *model_.catalogue;
    const double wanted = std::clamp(control_.steer(), -1.0, 1.0) * m.max_steering_angle;
    const double turn = std::clamp(
        wanted - steering_angle_, -world::steering_rate * step, world::steering_rate * step);
    if (turn == 0)
        return;
    steering_angle_ += turn;
    const world::AckermannAngles angles =
        world::ackermann(steering_angle_, m.wheelbase, model_.track);
    chassis_->car.setSteeringValue(angles.left, 0);
    chassis_->car.setSteeringValue(angles.right, 1);
}

void Vehicle::press_pedals(double road_friction, double step) {
    const world::VehicleModel& m = *model_.catalogue;
    RaycastCar& car = chassis_->car;
    car.grip = model_.grip * road_friction;

    const btVector3 x_ahead = body().getCenterOfMassTransform().getBasis().getColumn(0);
    const double speed = x_ahead.dot(body().getLinearVelocity());
    const double throttle = std::clamp(control_.throttle(), 0.0, 1.0);
    const double wanted = world::drive_force(model_, throttle, control_.reverse(), speed);
    const double force = driveline_.drive(wanted, throttle, control_.reverse(), speed, step);
    for (std::size_t i = 0; i < 4; ++i) {
        const bool front = i < 2;
        car.wheels[i].engine = front == model_.front_driven ? force / 2 : 0;
        // The hand brake locks the rear wheels under any load.
        car.wheels[i].locked = !front && control_.hand_brake();
    }
    car.total_brake = std::clamp(control_.brake(), 0.0, 1.0) * model_.brake_deceleration * m.mass;
}

/// Who lies off its wheels and has hardly moved for a while stays: Bullet's friction leaves some
/// millimetres a second, for ever. Who rocks is as slow at times, but not for so long.
void Vehicle::stay_where_it_lies(double step) {
    constexpr double off_its_wheels = 0.5;  // cosine of its lean
    constexpr double slow = 0.03;           // [m/s]
    constexpr double slow_spin = 0.1;       // [rad/s]
    constexpr double a_while = 0.5;         // [s]
    const bool lies =
        body().getCenterOfMassTransform().getBasis().getColumn(2).z() < off_its_wheels &&
        body().getLinearVelocity().length() < slow &&
        body().getAngularVelocity().length() < slow_spin;
    lies_still_ = lies ? lies_still_ + step : 0;
    if (lies_still_ < a_while)
        return;
    body().setLinearVelocity(btVector3(0, 0, 0));
    body().setAngularVelocity(btVector3(0, 0, 0));
}

void Vehicle::drive(double road_friction, double step) {
    stay_where_it_lies(step);
    const btVector3 velocity = body().getLinearVelocity();
    const double drag = 0.5 * world::air_density * model_.catalogue->drag_area * velocity.length();
    body().setLinearVelocity(velocity * (1 - drag * step / model_.catalogue->mass));

    steer(step);
    press_pedals(road_friction, step);
    RaycastCar& car = chassis_->car;
    car.updateVehicle(step);
    for (int i = 0; i < 4; ++i) {
        btWheelInfo& wheel = car.m_wheelInfo[i];
        if (i >= 2 && control_.hand_brake())
            wheel.m_rotation -= wheel.m_deltaRotation / 0.99;  // locked; Bullet has damped it since
        wheel.m_rotation = wrap_turn(wheel.m_rotation);
    }
}

// --- On a trajectory.

Eigen::Isometry3d Vehicle::pose() const {
    const btTransform& body_pose = body().getCenterOfMassTransform();
    Eigen::Isometry3d pose_world_body = Eigen::Isometry3d::Identity();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            pose_world_body.linear()(row, column) = body_pose.getBasis()[row][column];
        pose_world_body.translation()[row] = body_pose.getOrigin()[row];
    }
    return pose_world_body * Eigen::Translation3d(-model_.com_ahead, 0, -model_.com_height);
}

void Vehicle::follow(world::Trajectory trajectory, std::uint64_t start) {
    guide_.emplace(std::move(trajectory), start);
}

void Vehicle::let_go() {
    guide_.reset();
}

void Vehicle::teleport(const Eigen::Isometry3d& pose_world_vehicle, double speed) {
    btDynamicsWorld& bullet = *chassis_->world;
    guide_.reset();
    guided_ = false;
    steering_angle_ = 0;
    driveline_.settle(speed);
    put_down(bullet, pose_world_vehicle, speed);
}

void Vehicle::set_speed(double speed) {
    const btMatrix3x3& basis = body().getCenterOfMassTransform().getBasis();
    const double turn_rate = speed * std::tan(steering_angle_) / model_.catalogue->wheelbase;
    const btVector3 spin = basis.getColumn(2) * turn_rate;
    const btVector3 to_middle = basis * btVector3(model_.com_ahead, 0, 0);
    driveline_.settle(speed);
    body().setLinearVelocity(basis.getColumn(0) * speed + spin.cross(to_middle));
    body().setAngularVelocity(spin);
}

void Vehicle::move_as(const btVector3& velocity, const btVector3& spin, const btVector3& middle) {
    const btTransform& pose = body().getCenterOfMassTransform();
    body().setLinearVelocity(velocity + spin.cross(pose.getOrigin() - middle));
    body().setAngularVelocity(spin);
    const btVector3 foot = pose(btVector3(-model_.com_ahead, 0, -model_.com_height));
    last_velocity_ = to_vec3(velocity + spin.cross(foot - middle));
}

void Vehicle::tip_over() {
    if (!world::is_two_wheeler(model_.catalogue->body))
        return;
    constexpr double push = 0.6;  // [rad/s] a tenth of a metre a second at the rider's head
    const btVector3 ahead = body().getCenterOfMassTransform().getBasis().getColumn(0);
    const double leans = ahead.dot(body().getAngularVelocity());
    // Upright it may fall either way: by its id.
    const bool to_right = leans != 0 ? leans > 0 : id_ % 2 == 0;
    body().setAngularVelocity(body().getAngularVelocity() + ahead * (to_right ? push : -push));
}

/// Takes the body from forces and gives it back to them. Bullet sorts its bodies by what moves them
/// when they enter. A guided one meets whatever stands, too: nothing gives way, but it is noticed.
void Vehicle::hold(bool guided) {
    btRigidBody& held = chassis_->body;
    const btVector3 velocity = held.getLinearVelocity();
    const btVector3 spin = held.getAngularVelocity();
    btDynamicsWorld& bullet = *chassis_->world;
    bullet.removeRigidBody(&held);
    guided_ = guided;
    if (guided) {
        held.setMassProps(0, btVector3(0, 0, 0));
        held.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
        bullet.addRigidBody(&held, btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter);
    } else {
        held.setCollisionFlags(0);
        held.setMassProps(model_.catalogue->mass, to_bullet(model_.inertia));
        bullet.addRigidBody(&held);
    }
    held.updateInertiaTensor();
    held.setActivationState(DISABLE_DEACTIVATION);
    held.setInterpolationWorldTransform(held.getCenterOfMassTransform());
    held.setLinearVelocity(velocity);
    held.setAngularVelocity(spin);
}

void Vehicle::aim(std::uint64_t tick, double step) {
    if (guide_ && guide_->is_over(tick, step))
        guide_.reset();
    if (guide_.has_value() != guided_)
        hold(guide_.has_value());
    if (guide_)
        guide_->aim(tick, step, *ground_, *model_.catalogue, pose());
}

void Vehicle::be_guided(double share) {
    const Eigen::Isometry3d pose_world_body =
        guide_->pose_after(share) * Eigen::Translation3d(model_.com_ahead, 0, model_.com_height);
    // Bullet takes the velocity from the difference to where it was.
    body().setWorldTransform(to_bullet(pose_world_body));
}

void Vehicle::move_as_guided() {
    btRigidBody& held = body();
    const btVector3 to_middle = held.getCenterOfMassTransform().getBasis() *
                                btVector3(model_.com_ahead, 0, model_.com_height);
    const btVector3 spin = to_bullet(guide_->angular_velocity());
    held.setLinearVelocity(to_bullet(guide_->velocity()) + spin.cross(to_middle));
    held.setAngularVelocity(spin);
    held.setInterpolationWorldTransform(held.getCenterOfMassTransform());
    held.updateInertiaTensor();
}

void Vehicle::settle(double step) {
    move_as_guided();
    const btRigidBody& held = body();
    driveline_.settle(
        held.getCenterOfMassTransform().getBasis().getColumn(0).dot(held.getLinearVelocity()));
    roll_wheels(step);
}

void Vehicle::break_loose(double share) {
    be_guided(share);
    move_as_guided();
    hold(false);
}

void Vehicle::fall_in(double step) {
    hold(true);
    be_guided(1);
    settle(step);
}

/// As wheels that neither slip nor hang in the air.
void Vehicle::roll_wheels(double step) {
    constexpr double slow = 0.5;  // [m/s] a standing car's wheels stay as they are
    const world::VehicleModel& m = *model_.catalogue;
    RaycastCar& car = chassis_->car;
    const btMatrix3x3& basis = body().getCenterOfMassTransform().getBasis();
    const double speed = basis.getColumn(0).dot(to_bullet(guide_->velocity()));
    const double turn_rate = basis.getColumn(2).dot(to_bullet(guide_->angular_velocity()));
    if (std::abs(speed) > slow) {
        steering_angle_ = std::clamp(std::atan(m.wheelbase * turn_rate / speed),
                                     -m.max_steering_angle,
                                     m.max_steering_angle);
        const world::AckermannAngles angles =
            world::ackermann(steering_angle_, m.wheelbase, model_.track);
        car.setSteeringValue(angles.left, 0);
        car.setSteeringValue(angles.right, 1);
    }
    chassis_->rays.begin();
    for (int i = 0; i < 4; ++i) {
        btWheelInfo& wheel = car.m_wheelInfo[i];
        car.rayCast(wheel);
        const double left = (i % 2 == 0 ? 0.5 : -0.5) * model_.track;
        const double ahead = i < 2 ? m.wheelbase : 0;
        const double along = (speed - turn_rate * left) * std::cos(wheel.m_steering) +
                             turn_rate * ahead * std::sin(wheel.m_steering);
        const double share = (i < 2 ? model_.front_share : 1 - model_.front_share) / 2;
        wheel.m_deltaRotation = along * step / m.wheel_radius;
        wheel.m_rotation = wrap_turn(wheel.m_rotation + wheel.m_deltaRotation);
        wheel.m_wheelsSuspensionForce =
            wheel.m_raycastInfo.m_isInContact ? share * m.mass * world::gravity : 0;
        wheel.m_skidInfo = 1;
    }
}

// --- What is recorded.

world::VehicleState Vehicle::state_after(double step) {
    const btTransform& pose = body().getCenterOfMassTransform();
    const btVector3 arm = pose.getBasis() * btVector3(-model_.com_ahead, 0, -model_.com_height);
    const btVector3 position = pose.getOrigin() + arm;
    const btVector3 velocity = body().getVelocityInLocalPoint(arm);
    const btVector3 acceleration = (velocity - to_bullet(last_velocity_)) / step;
    odometer_ += (position - to_bullet(last_position_)).length();
    last_position_ = to_vec3(position);
    last_velocity_ = to_vec3(velocity);

    // Who is guided brakes where its trajectory does.
    constexpr double visible_braking = 1;  // [m/s^2]
    const double speed_change = acceleration.dot(pose.getBasis().getColumn(0));
    std::uint16_t lamps = control_.lamps();
    if (guided_ ? speed_change < -visible_braking : control_.brake() > 0)
        lamps |= world::lamp_brake;
    if (!guided_ && control_.reverse())
        lamps |= world::lamp_reverse;
    return {last_position_,
            to_quat(pose.getRotation()),
            last_velocity_,
            to_vec3(body().getAngularVelocity()),
            to_vec3(acceleration),
            steering_angle_,
            odometer_,
            id_,
            model_index_,
            lamps,
            static_cast<float>(driveline_.engine_speed()),
            static_cast<std::int8_t>(driveline_.gear()),
            0,
            0};
}

world::WheelState Vehicle::wheel(int index) const {
    const btWheelInfo& wheel = chassis_->car.getWheelInfo(index);
    const ground::Surface surface = chassis_->rays.surface(index);
    return {wheel.m_raycastInfo.m_suspensionLength,
            wheel.m_rotation,
            wheel.m_steering,
            wheel.m_wheelsSuspensionForce,
            static_cast<float>(wheel.m_skidInfo),
            id_,
            static_cast<std::uint8_t>(index),
            wheel.m_raycastInfo.m_isInContact,
            static_cast<std::uint8_t>(surface),
            chassis_->car.abs[static_cast<std::size_t>(index)],
            0};
}

void Vehicle::nudge(std::string_view field, std::int64_t units) {
    constexpr std::string_view wheels = "wheels[";
    if (field.starts_with(wheels)) {
        const int index = field[wheels.size()] - '0';
        nudge_wheel(index, field.substr(field.find('.') + 1), units);
        return;
    }
    const auto move = [units](btScalar& number) { number = moved_by_units(number, units); };
    if (field == "steering_angle")
        move(steering_angle_);
    if (field == "odometer")
        move(odometer_);
    if (field == "engine_speed")
        driveline_.set_engine_speed(moved_by_units(driveline_.engine_speed(), units));
    btTransform pose = body().getCenterOfMassTransform();
    btQuaternion turn = pose.getRotation();
    btVector3 velocity = body().getLinearVelocity();
    btVector3 spin = body().getAngularVelocity();
    if (field == "orientation.w")
        move(turn[3]);
    constexpr std::array axes{"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        const std::string end = std::string(".") + axes[static_cast<std::size_t>(axis)];
        if (field == "position" + end)
            move(pose.getOrigin()[axis]);
        if (field == "orientation" + end)
            move(turn[axis]);
        if (field == "velocity" + end)
            move(velocity[axis]);
        if (field == "angular_velocity" + end)
            move(spin[axis]);
    }
    if (field.starts_with("orientation"))
        pose.setRotation(turn);
    body().setCenterOfMassTransform(pose);
    body().setLinearVelocity(velocity);
    body().setAngularVelocity(spin);
}

void Vehicle::nudge_wheel(int index, std::string_view field, std::int64_t units) {
    btWheelInfo& wheel = chassis_->car.m_wheelInfo[index];
    const auto move = [units](btScalar& number) { number = moved_by_units(number, units); };
    if (field == "suspension_length")
        move(wheel.m_raycastInfo.m_suspensionLength);
    if (field == "rotation")
        move(wheel.m_rotation);
    if (field == "steering_angle")
        move(wheel.m_steering);
    if (field == "suspension_force")
        move(wheel.m_wheelsSuspensionForce);
}

void Vehicle::add_to(world::Hasher& hasher) const {
    hasher.add(id_);
    hasher.add(model_index_);
    add_transform(hasher, body().getCenterOfMassTransform());
    add_vector(hasher, body().getLinearVelocity());
    add_vector(hasher, body().getAngularVelocity());
    hasher.add(control_);
    hasher.add(steering_angle_);
    hasher.add(odometer_);
    driveline_.add_to(hasher);
    hasher.add(last_position_);
    hasher.add(last_velocity_);
    for (int i = 0; i < 4; ++i) {
        hasher.add(wheel(i));
        hasher.add(chassis_->car.getWheelInfo(i).m_deltaRotation);
    }
    if (guide_)
        guide_->add_to(hasher);
    if (guided_)
        hasher.add(guided_);
    if (lies_still_ > 0)
        hasher.add(lies_still_);
}

}  // namespace reprise::kernel
