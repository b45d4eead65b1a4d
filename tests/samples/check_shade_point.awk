# Whether what samples/shade_point prints is right. Diffuse: the integral over the screen, 800 x 400 points, 0.105337.
# Specular: the same of GGX times Schlick's reflectance, 2000 x 1000 points, 0.192645; the fitted lobes may be 1 % off
# (one lobe times two albedos would be 10 % off). Visibility: between 0.4 and 0.8.
function near(value, right, tolerance) {
    if (value >= right - tolerance && value <= right + tolerance) ++good
    else print "got " value " in place of " right
}
/^unshadowed:/ { near($3, 0.105337, 0.00001); near($5, 0.192645, 0.0019); diffuse = $3; specular = $5 }
/^visible/ { near($2 + 0, 0.6, 1e-6); near($4, 0.6 * diffuse, 0.00002); near($6, 0.6 * specular, 0.00002) }
END { exit good == 5 ? 0 : 1 }
