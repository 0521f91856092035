#pragma once
// Small scenes for tests that go through the program.

#include <string>

namespace tessera {

// A world with one sphere, as one frame. `radius` tells frames apart.
inline std::string sphere_world(double radius = 1.0) {
  const std::string r = std::to_string(radius);
  return "WorldBegin\n"
         "LightSource \"distantlight\" 1 \"intensity\" [1] \"from\" [1 1 -1] \"to\" [0 0 0]\n"
         "Surface \"matte\"\n"
         "Sphere " +
         r + " -" + r + " " + r +
         " 360\n"
         "WorldEnd\n";
}

inline std::string sphere_camera(int width = 32, int height = 24) {
  return "Format " + std::to_string(width) + " " + std::to_string(height) +
         " 1\n"
         "PixelSamples 2 2\n"
         "Projection \"perspective\" \"fov\" [40]\n"
         "Translate 0 0 4\n";
}

// One frame, no Display.
inline std::string sphere_scene(int width = 32, int height = 24) {
  return sphere_camera(width, height) + sphere_world();
}

// Motion of the camera and of surfaces, an open lens, transparency, several kinds of surface.
inline std::string everything_scene() {
  return "Format 80 60 1\n"
         "PixelSamples 3 3\n"
         "PixelFilter \"gaussian\" 3 3\n"
         "Shutter 0 1\n"
         "Projection \"perspective\" \"fov\" [45]\n"
         "DepthOfField 2 0.4 5\n"
         "MotionBegin [0 1]\nTranslate 0 0 5\nTranslate 0.2 0.1 5\nMotionEnd\n"
         "WorldBegin\n"
         "LightSource \"ambientlight\" 1 \"intensity\" [0.2]\n"
         "LightSource \"pointlight\" 2 \"intensity\" [30] \"from\" [2 3 -4]\n"
         "Surface \"plastic\"\n"
         "AttributeBegin\n"
         "MotionBegin [0 1]\nTranslate -1 0 0\nTranslate -0.4 0.3 0.5\nMotionEnd\n"
         "Color [0.8 0.2 0.2]\nSphere 0.8 -0.8 0.8 360\n"
         "AttributeEnd\n"
         "AttributeBegin\n"
         "Opacity [0.4 0.5 0.6]\nColor [0.2 0.8 0.3]\n"
         "Patch \"bilinear\" \"P\" [-1.5 -1 -1  1.5 -1 -1  -1.5 1 -0.5  1.5 1 -1.5]\n"
         "AttributeEnd\n"
         "AttributeBegin\n"
         "Translate 1 0 1\nRotate 30 1 1 0\nColor [0.3 0.4 0.9]\n"
         "SubdivisionMesh \"catmull-clark\" [4 4 4 4 4 4]\n"
         "  [0 1 3 2  4 6 7 5  0 4 5 1  2 3 7 6  0 2 6 4  1 5 7 3] [\"interpolateboundary\"] [0 0] "
         "[] []\n"
         "  \"P\" [-1 -1 -1  1 -1 -1  -1 1 -1  1 1 -1  -1 -1 1  1 -1 1  -1 1 1  1 1 1]\n"
         "AttributeEnd\n"
         "Surface \"checker\"\n"
         "Polygon \"P\" [-6 -1.5 -3  -6 -1.5 9  6 -1.5 9  6 -1.5 -3]\n"
         "WorldEnd\n";
}

// A lens that is focused behind a ball and on the floor, under a light with extent whose light
// bounces.
inline std::string rays_scene() {
  return "Format 32 24 1\n"
         "PixelSamples 2 2\n"
         "Projection \"perspective\" \"fov\" [45]\n"
         "DepthOfField 1 0.5 5\n"
         "Translate 0 -0.5 4\n"
         "WorldBegin\n"
         "TransformBegin\nTranslate 0 4 0\nRotate 90 1 0 0\n"
         "LightSource \"rectanglelight\" 1 \"float intensity\" [9]\n"
         "TransformEnd\n"
         "LightSource \"indirectlight\" 2\n"
         "Surface \"matte\"\n"
         "Sphere 1 -1 1 360\n"
         "Polygon \"P\" [-4 -1 -3  -4 -1 4  4 -1 4  4 -1 -3]\n"
         "WorldEnd\n";
}

}  // namespace tessera
