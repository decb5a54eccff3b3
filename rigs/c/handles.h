// What the opaque pointers of the C interface point to.
#pragma once

#include <rigel/crowd.h>
#include <rigel/light_tree.h>
#include <rigel/rigel.h>

#include <utility>
#include <variant>

struct rigel_kind {
  std::shared_ptr<const rigel::CrowdKind> kind;
};

struct rigel_lights {
  struct Frame {
    rigel::LightSet set;
    rigel::PreparedLights prepared;
    std::vector<std::uint32_t> ids;
    rigel::LightTree tree;
    bool hasTree = false;
  };
  Frame current;
  Frame next;                         // filled before it takes the other's place: a call that fails changes nothing
  std::vector<std::uint32_t> sorted;  // scratch
};

struct rigel_crowd {
  std::variant<rigel::Crowd<2>, rigel::Crowd<3>, rigel::Crowd<4>, rigel::Crowd<5>> bands;
  std::vector<std::shared_ptr<const rigel::CrowdKind>> kinds;  // by their number in the crowd
  bool torn = false;                                           // the last frame was not done

  template <class F>
  decltype(auto) visit(F&& f) {
    return std::visit(std::forward<F>(f), bands);
  }
  template <class F>
  decltype(auto) visit(F&& f) const {
    return std::visit(std::forward<F>(f), bands);
  }
};
