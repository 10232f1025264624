#pragma once

#include <unistd.h>
#include <utility>

namespace reprise::remote {

/// An open file of this process, closed with its owner.
class Descriptor {
  public:
    Descriptor() = default;

    explicit Descriptor(int number) : number_(number) {}

    ~Descriptor() {
        if (number_ >= 0)
            close(number_);
    }

    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }

    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int number() const { return number_; }  ///< below 0: none

  private:
    int number_ = -1;
};

}  // namespace reprise::remote
