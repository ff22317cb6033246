// gallery.inl - Contents of `make gallery`, as rows of four pictures. hair-capture makes each
// picture with the arguments beside its caption. Paths are relative to the folder that make runs
// in.
#define CLOSE "tools/scenes/portrait.json "
#define FINE "--followers 60000 --set strand.radius=7e-5 --guides 400 "
#define BLUNT FINE "--set strand.length_variation=0.15 "
#define CROPPED \
    FINE "--set strays.fraction=0.15 --set strays.distance=0,0.03,0.05,0.07,0.08,0.08,0.08,0.08 "
#define MELANIN(eumelanin, pheomelanin) \
    "--set pigment.weight=1 --set pigment.eumelanin=" eumelanin " --set pigment.pheomelanin=" pheomelanin " "
// One guide per lock. Wide curls form fewer locks.
#define TYPE(name, locks) \
    CLOSE "--set strand.radius=9e-5 --followers 24000 --set look=" name " --guides " locks

ROW("Haircuts")
PICTURE("Long, parted in the middle", CLOSE FINE)
PICTURE("Bob", CLOSE BLUNT "--style bob")
PICTURE("Short", CLOSE CROPPED "--style short")
PICTURE("Ponytail", FINE "--scene ponytail --motion still --frames 0:1")

ROW("Haircuts that are cut close or tied up")
PICTURE("Fringe", CLOSE BLUNT "--style fringe")
PICTURE("Fade", CLOSE CROPPED "--style fade")
PICTURE("Bun", FINE "--scene bun --motion still --frames 0:1")
PICTURE("Braid", FINE "--scene braid --motion still --frames 0:1")

ROW("Curls: the strands of a lock turn together and drift apart towards their tips")
PICTURE("Type 2b: waves of 20 mm", TYPE("2b", "200"))
PICTURE("Type 3a: curls of 25 mm", TYPE("3a", "200"))
PICTURE("Type 3b: ringlets of 14 mm", TYPE("3b", "300"))
PICTURE("An afro of coils",
        "--scene afro --motion still --frames 0:1 --followers 30000 --set strand.radius=9e-5")

ROW("Colours")
PICTURE("Blond", CLOSE FINE "--set color=blond")
PICTURE("Red", CLOSE FINE "--set color=red")
PICTURE("Black", CLOSE FINE "--set color=black")
PICTURE("White", CLOSE FINE "--set color=white")

ROW("Colours by the pigments of hair, and by dye")
PICTURE("A little of both melanins", CLOSE FINE MELANIN("0.05", "0.06"))
PICTURE("Pheomelanin and some eumelanin", CLOSE FINE MELANIN("0.08", "0.9"))
PICTURE("Much eumelanin", CLOSE FINE MELANIN("1.3", "0.2"))
PICTURE("Blue dye on blond hair", CLOSE FINE MELANIN("0.3", "0.1")
        "--set pigment.dye.r=0.25 --set pigment.dye.g=0.5 --set pigment.dye.b=0.9")

ROW("Colours that vary from strand to strand and along it")
PICTURE("Bright streaks and dark roots",
        CLOSE FINE "--set color.streaks=0.25 --set color.root_darkening=0.6")
PICTURE("Dark hair, of which a third is grey",
        CLOSE FINE "--set color=dark_brown --set color.streaks=0.3 --set color.streak_clumping=0 --set "
                   "color.streak_color.r=0.6 --set color.streak_color.g=0.6 --set color.streak_color.b=0.6")
PICTURE("Blue tips",
        CLOSE FINE "--set color=blond --set color.tint_red=1,1,1,1,0.8,0.35,0.1,0.05 --set "
                   "color.tint_green=1,1,1,1,0.9,0.7,0.5,0.4 --set color.tint_blue=1,1,1,1,1.5,2.2,2.5,2.5")
PICTURE("A frozen look, by a shader of the application", CLOSE FINE "--shader tools/scenes/frost.glsl")

ROW("The same haircut, dry and wet, neat and frizzy")
PICTURE("No strays", CLOSE FINE "--set strays.tip_fraction=0 --set strays.fraction=0 --set "
                                "strays.frizz_fraction=0")
PICTURE("A third of the strands stray", CLOSE FINE)
PICTURE("Frizz on every strand", CLOSE FINE "--set look=frizzy")
PICTURE("Wet: darker, glossier, in strings", CLOSE FINE "--set wetness=1 --set preset=wet")

ROW("Wind as a fluid around the head: blue air is slower than the wind, red air is faster")
PICTURE("Wind of 3 m/s from the left and the front", "--scene wind --frames 24:25")
PICTURE("A fifth of a second later", "--scene wind --frames 30:31")
PICTURE("The air", "--scene wind --show head,wind --frames 24:25")
PICTURE("The air, a fifth of a second later", "--scene wind --show head,wind --frames 30:31")

ROW("Curls keep their shape while the head is shaken for 0.6 s")
PICTURE("Before", "tools/scenes/curls.json --frames 0:1")
PICTURE("While the head turns", "tools/scenes/curls.json --frames 12:13")
PICTURE("As the shake ends", "tools/scenes/curls.json --frames 18:19")
PICTURE("At rest again, 1.7 s later", "tools/scenes/curls.json --frames 69:70")

ROW("So do coils")
PICTURE("Before", "tools/scenes/curls.json --style afro --frames 0:1")
PICTURE("While the head turns", "tools/scenes/curls.json --style afro --frames 12:13")
PICTURE("As the shake ends", "tools/scenes/curls.json --style afro --frames 18:19")
PICTURE("At rest again, 1.7 s later", "tools/scenes/curls.json --style afro --frames 69:70")

ROW("A ball comes into hair")
PICTURE("Only the simulated guides collide with it",
        "tools/scenes/ball.json --show hair,colliders --set followers.collision=none")
PICTURE("Strands follow one guide below the point where they meet it",
        "tools/scenes/ball.json --show hair,colliders --set followers.collision=single_guide")
PICTURE("Strands are pushed out of it, the default",
        "tools/scenes/ball.json --show hair,colliders --set followers.collision=push_out")
PICTURE("The guides, and the distance to solids: blue outside, red inside",
        "tools/scenes/ball.json --show guides,colliders --set slice=x --set slice_at=0.72")

ROW("From guides to strands")
PICTURE("166 simulated guides", CLOSE "--show head,guides")
PICTURE("Each strand follows one guide", CLOSE "--set clump.interpolation=single")
PICTURE("Each strand lies between three guides", CLOSE "--set clump.interpolation=multi")
PICTURE("Between three at the root, with one at the tip, the default", CLOSE)

ROW("Shadow of the hair on itself")
PICTURE("From depth behind the light's shadow map", CLOSE "--set self_shadow.method=depth")
PICTURE("Along strands, and through a grid of the density", CLOSE)
PICTURE("From depth, on blond hair", CLOSE "--set self_shadow.method=depth --set color=blond")
PICTURE("Along strands, on blond hair", CLOSE "--set color=blond")

ROW("Lights, maps and objects")
PICTURE("A white, a blue and a red lamp", "tools/scenes/lights.json --set color=blond")
PICTURE("A map of where hair grows", "tools/scenes/maps.json --set followers.map_set=1")
PICTURE("Objects of a Bullet world", "tools/scenes/bullet.json --show hair,colliders")
PICTURE("Fur on a ball", "--scene fur")

ROW("Thin strands, far away")
PICTURE("One sample a pixel", "tools/scenes/far.json --samples 1 --supersample 1")
PICTURE("Four samples a pixel", "tools/scenes/far.json --supersample 1")
PICTURE("One sample, blended by the covered part of the pixel",
        "tools/scenes/far.json --samples 1 --supersample 1 --set coverage=alpha")
PICTURE("64 samples, as all other pictures here", "tools/scenes/far.json")

ROW("Level of detail: fewer and wider strands of fewer segments")
PICTURE("All strands", "tools/scenes/far.json")
PICTURE("15 % of the strands",
        "tools/scenes/far.json --set lod=on --set lod.per_patch=0 --set lod.strand_fraction=0.15 --set "
        "lod.segment_fraction=0.5")
PICTURE("All strands, zoomed in", "tools/scenes/near.json --set lod=on")
PICTURE("15 % of the strands, zoomed in",
        "tools/scenes/near.json --set lod=on --set lod.per_patch=0 --set lod.strand_fraction=0.15 --set "
        "lod.segment_fraction=0.5")
#undef CLOSE
#undef FINE
#undef BLUNT
#undef CROPPED
#undef TYPE
