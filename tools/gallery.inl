// gallery.inl - what `make gallery` shows: rows of pictures, each made by hair-capture with the arguments beside its
// caption. Paths start where make does.
ROW("Followers and solids: a ball comes into hair that follows three guides at once")
PICTURE("Guides collide; no follower does (collision=none)",
        "tools/scenes/ball.json --show hair,head,solids --set collision=none")
PICTURE("Single strand below the first vertex inside (collision=switch)",
        "tools/scenes/ball.json --show hair,head,solids --set collision=switch")
PICTURE("Pushed out, smoothly (collision=push, the default)",
        "tools/scenes/ball.json --show hair,head,solids --set collision=push")
PICTURE("The guides, and a slice of the field: blue outside, red inside",
        "tools/scenes/ball.json --show guides,solids --set slice=x --set slice_at=0.72")

ROW("Maps on the scalp: where hair grows, and how thick it is, in sets that are blended")
PICTURE("The first set: all of it", "tools/scenes/maps.json")
PICTURE("On the way to the second (map_set=0.6)", "tools/scenes/maps.json --set map_set=0.6")
PICTURE("The second: a middle, a few on the sides, none between", "tools/scenes/maps.json --set map_set=1")
PICTURE("The third: strands of a third and of twice the thickness", "tools/scenes/maps.json --set map_set=2")

ROW("Solids from a Bullet world")
PICTURE("Objects of a Bullet world: hull, meshes, height field, compound",
        "tools/scenes/bullet.json --show hair,head,solids")
