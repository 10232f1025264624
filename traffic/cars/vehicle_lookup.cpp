// What it must do: answer libsumo's question for a vehicle of a name, as libsumo does.
// What it assumes: libsumo asks libsumo::Helper::getVehicle, by a name that the program may take
//   over, as it takes gettext (sumo.cpp). Where a libsumo does not, nothing here is called, and
//   nothing but the time differs.
// How it goes: by the one name that is known, which is told apart by where it lies in memory, the
//   vehicle that was found for it before. Else libsumo's own.
// What it keeps: for each thread the name that it knows, and where its vehicle is kept.
#include "traffic/cars/vehicle_lookup.h"

#include <dlfcn.h>
#include <string>

#include "world/check.h"

#define REPRISE_GET_VEHICLE \
    "_ZN7libsumo6Helper10getVehicleERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE"

namespace reprise::traffic {

namespace {

using Lookup = void* (*)(const std::string& name);

thread_local const std::string* known_name = nullptr;
thread_local void** known_vehicle = nullptr;

/// Throws libsumo's own exception where there is none of this name.
void* look_up(const std::string& name) {
    static const auto theirs = reinterpret_cast<Lookup>(dlsym(RTLD_NEXT, REPRISE_GET_VEHICLE));
    REPRISE_CHECK(theirs != nullptr, "libsumo has no Helper::getVehicle");
    return theirs(name);
}

}  // namespace

/// libsumo's Helper::getVehicle; its class is not declared in what is installed.
void* get_vehicle(const std::string& name) asm(REPRISE_GET_VEHICLE);

void* get_vehicle(const std::string& name) {
    if (&name != known_name)
        return look_up(name);
    if (*known_vehicle == nullptr)
        *known_vehicle = look_up(name);
    return *known_vehicle;
}

KnownVehicle::KnownVehicle(const std::string& name, void*& vehicle) {
    known_name = &name;
    known_vehicle = &vehicle;
}

KnownVehicle::~KnownVehicle() {
    known_name = nullptr;
}

}  // namespace reprise::traffic
