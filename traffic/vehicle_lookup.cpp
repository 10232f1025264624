// What it must do: answer libsumo's question for a vehicle of a name, as libsumo does.
// What it assumes: libsumo asks libsumo::Helper::getVehicle, by a name that the program may take
//   over, as it takes gettext (sumo.cpp). Where a libsumo does not, nothing here is called, and
//   nothing but the time differs.
// How it goes: the same name again, in one OneLookup's life: the same vehicle. Else libsumo's own.
// What it keeps: the vehicle that was asked for last.
#include "traffic/vehicle_lookup.h"

#include <dlfcn.h>
#include <string>

#include "world/check.h"

#define REPRISE_GET_VEHICLE \
    "_ZN7libsumo6Helper10getVehicleERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE"

namespace reprise::traffic {

namespace {

using Lookup = void* (*)(const std::string& name);

struct Last {
    bool counts = false;  // libsumo is a global of the process, and so is this
    std::string name;
    void* vehicle = nullptr;
};

Last last;

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
    if (!last.counts)
        return look_up(name);
    if (last.vehicle == nullptr || last.name != name) {
        last.vehicle = nullptr;
        last.vehicle = look_up(name);
        last.name = name;
    }
    return last.vehicle;
}

OneLookup::OneLookup() {
    last.vehicle = nullptr;
    last.counts = true;
}

OneLookup::~OneLookup() {
    last.counts = false;
}

}  // namespace reprise::traffic
