// gallery.inl - Contents of `make gallery`, as rows of pictures. hair-capture makes each picture
// with the arguments beside its caption. Paths are relative to the folder that make runs in.
ROW("Followers and colliders: a ball comes into hair that follows three guides at once")
PICTURE("Guides collide, and followers do not (followers.collision=none)",
        "tools/scenes/ball.json --show hair,head,colliders --set followers.collision=none")
PICTURE("Single strand below the first vertex inside (followers.collision=single_guide)",
        "tools/scenes/ball.json --show hair,head,colliders --set followers.collision=single_guide")
PICTURE("Pushed out, smoothly (followers.collision=push_out, the default)",
        "tools/scenes/ball.json --show hair,head,colliders --set followers.collision=push_out")
PICTURE("The guides, and a slice of the field: blue outside, red inside",
        "tools/scenes/ball.json --show guides,colliders --set slice=x --set slice_at=0.72")

ROW("Maps on the scalp: where hair grows, and how thick it is, in sets that are blended")
PICTURE("The first set: all of it", "tools/scenes/maps.json")
PICTURE("On the way to the second (followers.map_set=0.6)",
        "tools/scenes/maps.json --set followers.map_set=0.6")
PICTURE("The second: a middle, a few on the sides, none between",
        "tools/scenes/maps.json --set followers.map_set=1")
PICTURE("The third: strands of a third and of twice the thickness",
        "tools/scenes/maps.json --set followers.map_set=2")

ROW("Colliders from a Bullet world")
PICTURE("Objects of a Bullet world: hull, meshes, height field, compound",
        "tools/scenes/bullet.json --show hair,head,colliders")

ROW("Wind as a fluid around the head, with gusts; air slower than the wind is blue, and faster air is red")
PICTURE("Wind of 3 m/s from the left", "--scene wind --frames 24:25")
PICTURE("A fifth of a second later", "--scene wind --frames 30:31")
PICTURE("The air (--show wind)", "--scene wind --show head,wind --frames 24:25")
PICTURE("A fifth of a second later", "--scene wind --show head,wind --frames 30:31")
PICTURE("The wind on a lock: drag=0.1", "--scene wind --set drag=0.1 --frames 24:25")

ROW("Three ways to make followers of the same guides")
PICTURE("Single strand: offsets from one guide (clump.interpolation=single)",
        "--scene demo --set clump.interpolation=single")
PICTURE("Multi strand: between three guides (clump.interpolation=multi)",
        "--scene demo --set clump.interpolation=multi")
PICTURE("Both, by a curve from root to tip (the default)", "--scene demo")

ROW("Random variation")
PICTURE("None", "--scene demo --set strays.tip_fraction=0 --set strays.fraction=0")
PICTURE("30 % stray near their tips, 10 % all along (the default)", "--scene demo")
PICTURE("Every strand has frizz too (look=frizzy)", "--scene demo --set look=frizzy")

ROW("Looks of one haircut")
PICTURE("look=straight", "--scene demo --set look=straight")
PICTURE("look=wavy", "--scene demo --set look=wavy")
PICTURE("look=curly", "--scene demo --set look=curly")
PICTURE("look=coily", "--scene demo --set look=coily")
PICTURE("look=short", "--scene demo --set look=short")

ROW("Curls keep their shape: style=curly, whose head is shaken for 0.6 s")
PICTURE("Before", "tools/scenes/curls.json --frames 0:1")
PICTURE("While the head turns", "tools/scenes/curls.json --frames 12:13")
PICTURE("As the shake ends", "tools/scenes/curls.json --frames 18:19")
PICTURE("At rest again, 1.7 s later", "tools/scenes/curls.json --frames 69:70")

ROW("Coils keep their shape: style=afro, whose head is shaken for 0.6 s")
PICTURE("Before", "tools/scenes/curls.json --style afro --frames 0:1")
PICTURE("While the head turns", "tools/scenes/curls.json --style afro --frames 12:13")
PICTURE("As the shake ends", "tools/scenes/curls.json --style afro --frames 18:19")
PICTURE("At rest again, 1.7 s later", "tools/scenes/curls.json --style afro --frames 69:70")

ROW("Colours")
PICTURE("color=brown (the default)", "--scene demo")
PICTURE("color=dark_brown", "--scene demo --set color=dark_brown")
PICTURE("color=black", "--scene demo --set color=black")
PICTURE("color=blond", "--scene demo --set color=blond")
PICTURE("color=red", "--scene demo --set color=red")
PICTURE("color=auburn", "--scene demo --set color=auburn")
PICTURE("color=gray", "--scene demo --set color=gray")
PICTURE("color=white", "--scene demo --set color=white")
PICTURE("color=blue", "--scene demo --set color=blue")

ROW("Variety of one colour by chance, water, dye and light")
PICTURE("Wet (wetness=1): darker, glossier, in strings", "--scene demo --set wetness=1 --set preset=wet")
PICTURE("Streaks in locks, dark at the roots",
        "--scene demo --set color.streaks=0.25 --set color.root_darkening=0.6")
PICTURE("A fraction of grey hairs (streaks by strand)",
        "--scene demo --set color=dark_brown --set color.streaks=0.3 --set color.streak_clumping=0 --set "
        "color.streak_color.r=0.6 --set "
        "color.streak_color.g=0.6 --set color.streak_color.b=0.6")
PICTURE("Dyed tips: a ramp of eight colours",
        "--scene demo --set color=blond --set color.tint_red=1,1,1,1,0.8,0.35,0.1,0.05 --set "
        "color.tint_green=1,1,1,1,0.9,0.7,0.5,0.4 --set "
        "color.tint_blue=1,1,1,1,1.5,2.2,2.5,2.5")
PICTURE("Lines with a highlight that glitters (shading.sparkle=1)",
        "--scene demo --set shading.model=lines --set shading.sparkle=1")

ROW("Shading by the application, which calls the built-in shading")
PICTURE("Built-in shading, changed towards the tips (--shader frost.glsl)",
        "--scene demo --shader tools/scenes/frost.glsl")
PICTURE("Locks by number, darker from root to tip (--shader strands.glsl)",
        "--scene demo --shader tools/scenes/strands.glsl")

ROW("Thin strands: one sample a pixel, four, and one blended by coverage")
PICTURE("Opaque, one sample a pixel", "tools/scenes/far.json --samples 1 --supersample 1")
PICTURE("Opaque, four samples", "tools/scenes/far.json --supersample 1")
PICTURE("Fractions of pixels, sorted and blended (coverage=alpha), one sample",
        "tools/scenes/far.json --samples 1 --supersample 1 --set coverage=alpha")
PICTURE("Opaque, 64 samples, like all pictures of this sheet", "tools/scenes/far.json")

ROW("Level of detail: fewer and wider strands of fewer segments")
PICTURE("Full level of detail", "tools/scenes/far.json")
PICTURE("Lower level: 15 % of the strands, half the segments",
        "tools/scenes/far.json --set lod=on --set lod.per_patch=0 --set lod.strand_fraction=0.15 --set "
        "lod.segment_fraction=0.5")
PICTURE("Lower level, zoomed in",
        "tools/scenes/near.json --set lod=on --set lod.per_patch=0 --set lod.strand_fraction=0.15 --set "
        "lod.segment_fraction=0.5")
PICTURE("Full, zoomed in; lod=on selects the level by the size in the picture",
        "tools/scenes/near.json --set lod=on")

ROW("Self-shadow, with a lamp behind the hair")
PICTURE("By depth behind a shadow map (self_shadow.method=depth)",
        "--scene demo --set self_shadow.method=depth")
PICTURE("By strands: along them, and through a density grid (self_shadow.method=strands)",
        "--scene demo")
PICTURE("The same on blond hair", "--scene demo --set color=blond")

ROW("Lights")
PICTURE("A distant light, a blue point light, a red spotlight, all with shadows; ambient light",
        "tools/scenes/lights.json")
PICTURE("The same on blond hair", "tools/scenes/lights.json --set color=blond")
