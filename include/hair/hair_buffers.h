/// hair_buffers.h - the strands as OpenGL buffers, for passes of the application.
#ifndef HAIR_HAIR_BUFFERS_H
#define HAIR_HAIR_BUFFERS_H

#include <hair/hair_diagnostics.h>

/// Attributes of the vertices of strands, as bits.
typedef enum hair_attribute {
    /// Position relative to hair_buffers.origin, m, along the world axes. GL_RGB32F.
    HAIR_ATTRIBUTE_POSITION = 1,
    /// Radius, m. GL_R32F. Followers only.
    HAIR_ATTRIBUTE_RADIUS = 2,
    /// Unit direction of the strand. GL_RGB32F of guides. GL_RGB16 of followers, normalized, where
    /// the direction is twice the value minus 1.
    HAIR_ATTRIBUTE_TANGENT = 4,
    /// Reflectance, linear rgb, without light and without hair_view.color_texture. GL_RGBA16F, with
    /// an alpha of 1. Followers only.
    HAIR_ATTRIBUTE_COLOR = 8,
    /// Texture coordinates of the root on the scalp, per strand. GL_RG32F. Followers only.
    HAIR_ATTRIBUTE_ROOT_UV = 16,
    /// Index of the strand, the same for all its vertices. GL_R32UI.
    HAIR_ATTRIBUTE_STRAND = 32,
    /// Position in the previous frame, relative to hair_buffers.prev_origin. GL_RGB32F.
    HAIR_ATTRIBUTE_PREV_POSITION = 64
} hair_attribute;

/// One attribute in an OpenGL buffer.
typedef struct hair_buffer {
    uint32_t buffer; ///< Name of the buffer. 0 if the attribute was not asked for or is missing.
    uint32_t offset; ///< Offset of the first element, bytes.
    uint32_t stride; ///< Distance between elements, bytes.
    /// Sized internal format of an element, such as GL_RGB32F. It tells the type, the number of
    /// components, and whether integers are normalized.
    uint32_t format;
    uint32_t count; ///< Number of elements.
    bool is_per_strand; ///< True for one element per strand, false for one per vertex.
} hair_buffer;

/// Input and output of hair_get_buffers().
typedef struct hair_buffers {
    hair_struct_header header;
    /// Attributes to provide, bits of hair_attribute. Input. Others are not computed.
    uint32_t attributes; ///< [0, 127]. Default 1.
    /// Number of the frame. Input. Calls of one number and source share the previous frame. Motion
    /// vectors of views do not count. 0 begins a new frame with every call.
    uint32_t frame_index; ///< Default 0.
    hair_buffer position; ///< See HAIR_ATTRIBUTE_POSITION.
    hair_buffer radius; ///< See HAIR_ATTRIBUTE_RADIUS.
    hair_buffer tangent; ///< See HAIR_ATTRIBUTE_TANGENT.
    hair_buffer color; ///< See HAIR_ATTRIBUTE_COLOR.
    hair_buffer root_uv; ///< See HAIR_ATTRIBUTE_ROOT_UV.
    hair_buffer strand; ///< See HAIR_ATTRIBUTE_STRAND.
    hair_buffer prev_position; ///< See HAIR_ATTRIBUTE_PREV_POSITION.
    uint32_t strand_count; ///< Number of strands.
    /// Number of vertices of each strand. Vertex k of strand i is element i * strand_vertices + k.
    uint32_t strand_vertices;
    double origin[3]; ///< Origin of the positions in the world, m.
    double prev_origin[3]; ///< Origin of the previous positions in the world, m.
    /// Rotation of the previous positions about prev_origin, a unit quaternion xyzw. It is the
    /// identity unless the head was teleported.
    float prev_rotation[4];
    float lower[3]; ///< Lower corner of the bounds in the world, m, as of hair_get_bounds().
    float upper[3]; ///< Upper corner of the bounds in the world, m.
} hair_buffers;
HAIR_DESC(hair_buffers)

/// Provide the strands of the current frame in OpenGL buffers of the library, without copying them.
///
/// The buffers have the vertices that hair_read_positions() reads. Only the attributes that are
/// asked for are computed, and only if they are not up to date. Vertices of followers are those of
/// HAIR_RENDER_PATH_CACHED, and take the same memory. Colours take 8 bytes per vertex, indices of
/// strands 4, tangents of guides 16, and previous positions 16, beside those of motion vectors.
/// Memory that no call or view uses for 240 frames is freed.
///
/// Do not write to the buffers. Names and contents are valid until the next call for this instance
/// that needs OpenGL. Draw with them, or copy them, before that. The previous frame is the last of
/// another frame_index in which previous positions of the source were asked for.
///
/// Storage buffers and buffer textures may be read at once. Before any other use, issue
/// glMemoryBarrier() with the bit of that use, such as GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT.
///
/// @param source HAIR_READ_SMOOTH for guides as drawn, or HAIR_READ_FOLLOWERS.
/// @param out Attributes wanted, and receives the buffers. It comes from hair_buffers_default().
/// Errors: HAIR_ERROR_ARGUMENT, also for an attribute that guides do not have, HAIR_ERROR_MEMORY,
///     HAIR_ERROR_OPENGL, HAIR_ERROR_VERSION.
/// OpenGL: required. Does not wait for the GPU.
HAIR_API hair_result hair_get_buffers(hair_instance* hair, hair_read_source source,
                                      hair_buffers* out);

#endif
