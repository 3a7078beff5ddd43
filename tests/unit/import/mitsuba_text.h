#pragma once

#include <string>

namespace glimt::testing {

/// A scene of Mitsuba with what is imported of it; part.obj and part.ply are beside it.
inline const std::string mitsuba_room = R"(<?xml version="1.0"?>
<scene version="3.0.0">
  <default name="spp" value="32"/>
  <default name="size" value="120"/>
  <integrator type="path"><integer name="max_depth" value="8"/></integrator>
  <sensor type="perspective">
    <float name="fov" value="60"/>
    <string name="fov_axis" value="x"/>
    <transform name="to_world"><lookat origin="0, 1, 6" target="0, 1, 0" up="0, 1, 0"/></transform>
    <sampler type="independent"><integer name="sample_count" value="$spp"/></sampler>
    <film type="hdrfilm">
      <integer name="width" value="$size"/>
      <integer name="height" value="80"/>
      <rfilter type="box"/>
    </film>
  </sensor>
  <bsdf type="twosided" id="white"><bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.6, 0.5"/></bsdf></bsdf>
  <bsdf type="roughconductor" id="gold">
    <string name="distribution" value="ggx"/>
    <string name="material" value="Au"/>
    <float name="alpha" value="0.09"/>
  </bsdf>
  <bsdf type="conductor" id="mirror"><string name="material" value="none"/></bsdf>
  <bsdf type="dielectric" id="glass">
    <float name="int_ior" value="1.5"/>
    <float name="ext_ior" value="1"/>
  </bsdf>
  <bsdf type="roughdielectric" id="frosted">
    <string name="distribution" value="ggx"/>
    <string name="int_ior" value="water"/>
    <string name="ext_ior" value="vacuum"/>
    <float name="alpha" value="0.04"/>
  </bsdf>
  <shape type="rectangle" id="floor">
    <transform name="to_world">
      <rotate x="1" angle="-90"/>
      <scale value="5"/>
    </transform>
    <ref id="white"/>
  </shape>
  <shape type="rectangle" id="lamp">
    <transform name="to_world">
      <rotate x="1" angle="90"/>
      <translate y="4"/>
    </transform>
    <emitter type="area"><rgb name="radiance" value="9"/></emitter>
  </shape>
  <shape type="sphere" id="ball">
    <point name="center" x="-1.5" y="1" z="0"/>
    <float name="radius" value="0.8"/>
    <ref id="gold"/>
  </shape>
  <shape type="cube" id="block">
    <transform name="to_world">
      <scale x="0.4" y="0.5" z="0.6"/>
      <rotate y="1" angle="30"/>
      <translate x="1.5" y="0.6" z="0"/>
    </transform>
    <ref id="glass"/>
  </shape>
  <shape type="disk" id="plate">
    <transform name="to_world"><translate z="-3"/></transform>
    <bsdf type="diffuse"><spectrum name="reflectance" value="0.4"/></bsdf>
  </shape>
  <shape type="obj" id="solid">
    <string name="filename" value="part.obj"/>
    <boolean name="face_normals" value="true"/>
    <transform name="to_world">
      <scale value="0.5"/>
      <translate x="0" y="0.1" z="1"/>
    </transform>
    <ref id="frosted"/>
  </shape>
  <shape type="ply" id="other">
    <string name="filename" value="part.ply"/>
    <transform name="to_world"><matrix value="0 0 1 -3  0 1 0 0  -1 0 0 0  0 0 0 1"/></transform>
    <ref id="mirror"/>
  </shape>
</scene>
)";

}  // namespace glimt::testing
