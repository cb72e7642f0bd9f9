// gl_functions.h: the list of the OpenGL functions that Lambent calls, and the table of their addresses.
//
// loader.c looks up every function by name when a context is made, so Lambent links no function. The types come from
// the declarations in Debian's libgl-dev. One list serves OpenGL 3.3 and OpenGL ES 3.0.
#ifndef GL_FUNCTIONS_H
#define GL_FUNCTIONS_H

#define GL_GLEXT_PROTOTYPES // for __typeof__; a direct call would not link
#include <GL/gl.h>
#include <GL/glext.h>

// Required: part of both OpenGL 3.3 core and OpenGL ES 3.0.
#define GL_FUNCTIONS(X)                                                                                                \
    X(ActiveTexture)                                                                                                   \
    X(AttachShader)                                                                                                    \
    X(BeginQuery)                                                                                                      \
    X(BindBuffer)                                                                                                      \
    X(BindBufferBase)                                                                                                  \
    X(BindBufferRange)                                                                                                 \
    X(BindFramebuffer)                                                                                                 \
    X(BindRenderbuffer)                                                                                                \
    X(BindSampler)                                                                                                     \
    X(BindTexture)                                                                                                     \
    X(BindVertexArray)                                                                                                 \
    X(BlendEquation)                                                                                                   \
    X(BlendEquationSeparate)                                                                                           \
    X(BlendFunc)                                                                                                       \
    X(BlendFuncSeparate)                                                                                               \
    X(BufferData)                                                                                                      \
    X(BufferSubData)                                                                                                   \
    X(CheckFramebufferStatus)                                                                                          \
    X(Clear)                                                                                                           \
    X(ClearBufferfv)                                                                                                   \
    X(ClearBufferuiv)                                                                                                  \
    X(ClearColor)                                                                                                      \
    X(ColorMask)                                                                                                       \
    X(CompileShader)                                                                                                   \
    X(CreateProgram)                                                                                                   \
    X(CreateShader)                                                                                                    \
    X(CullFace)                                                                                                        \
    X(DeleteBuffers)                                                                                                   \
    X(DeleteFramebuffers)                                                                                              \
    X(DeleteProgram)                                                                                                   \
    X(DeleteQueries)                                                                                                   \
    X(DeleteRenderbuffers)                                                                                             \
    X(DeleteShader)                                                                                                    \
    X(DeleteSamplers)                                                                                                  \
    X(DeleteTextures)                                                                                                  \
    X(DeleteVertexArrays)                                                                                              \
    X(DepthFunc)                                                                                                       \
    X(DepthMask)                                                                                                       \
    X(Disable)                                                                                                         \
    X(DisableVertexAttribArray)                                                                                        \
    X(DrawArrays)                                                                                                      \
    X(DrawBuffers)                                                                                                     \
    X(DrawElements)                                                                                                    \
    X(Enable)                                                                                                          \
    X(EnableVertexAttribArray)                                                                                         \
    X(EndQuery)                                                                                                        \
    X(Finish)                                                                                                          \
    X(FramebufferRenderbuffer)                                                                                         \
    X(FramebufferTexture2D)                                                                                            \
    X(FrontFace)                                                                                                       \
    X(GenBuffers)                                                                                                      \
    X(GenFramebuffers)                                                                                                 \
    X(GenQueries)                                                                                                      \
    X(GenRenderbuffers)                                                                                                \
    X(GenSamplers)                                                                                                     \
    X(GenTextures)                                                                                                     \
    X(GenVertexArrays)                                                                                                 \
    X(GetActiveAttrib)                                                                                                 \
    X(GetActiveUniform)                                                                                                \
    X(GetActiveUniformBlockiv)                                                                                         \
    X(GetActiveUniformsiv)                                                                                             \
    X(GetAttribLocation)                                                                                               \
    X(GetBooleanv)                                                                                                     \
    X(GetError)                                                                                                        \
    X(GetFloatv)                                                                                                       \
    X(GetIntegeri_v)                                                                                                   \
    X(GetIntegerv)                                                                                                     \
    X(GetProgramInfoLog)                                                                                               \
    X(GetProgramiv)                                                                                                    \
    X(GetQueryObjectuiv)                                                                                               \
    X(GetShaderInfoLog)                                                                                                \
    X(GetShaderiv)                                                                                                     \
    X(GetString)                                                                                                       \
    X(GetStringi)                                                                                                      \
    X(GetUniformBlockIndex)                                                                                            \
    X(GetUniformLocation)                                                                                              \
    X(IsEnabled)                                                                                                       \
    X(LinkProgram)                                                                                                     \
    X(MapBufferRange)                                                                                                  \
    X(PixelStorei)                                                                                                     \
    X(ReadPixels)                                                                                                      \
    X(RenderbufferStorage)                                                                                             \
    X(SamplerParameterf)                                                                                               \
    X(SamplerParameteri)                                                                                               \
    X(Scissor)                                                                                                         \
    X(ShaderSource)                                                                                                    \
    X(TexImage2D)                                                                                                      \
    X(TexImage3D)                                                                                                      \
    X(TexParameteri)                                                                                                   \
    X(TexSubImage2D)                                                                                                   \
    X(Uniform1f)                                                                                                       \
    X(Uniform1fv)                                                                                                      \
    X(Uniform1i)                                                                                                       \
    X(Uniform1iv)                                                                                                      \
    X(Uniform2fv)                                                                                                      \
    X(Uniform3fv)                                                                                                      \
    X(Uniform4fv)                                                                                                      \
    X(UniformBlockBinding)                                                                                             \
    X(UniformMatrix3fv)                                                                                                \
    X(UniformMatrix4fv)                                                                                                \
    X(UnmapBuffer)                                                                                                     \
    X(UseProgram)                                                                                                      \
    X(VertexAttribPointer)                                                                                             \
    X(Viewport)

// Part of some versions only; NULL if the driver does not provide the function. Check the context's version and
// extensions before you call such a function, because a driver may provide a pointer for a function that it does not
// support.
#define GL_OPTIONAL_FUNCTIONS(X)                                                                                       \
    X(DebugMessageCallback) /* KHR_debug */                                                                            \
    X(DebugMessageControl)                                                                                             \
    X(PolygonMode) /* desktop */                                                                                       \
    X(Begin)       /* this and the following: compatibility contexts */                                                \
    X(EnableClientState)                                                                                               \
    X(End)                                                                                                             \
    X(Lightfv)                                                                                                         \
    X(LoadMatrixf)                                                                                                     \
    X(Materialfv)                                                                                                      \
    X(MatrixMode)                                                                                                      \
    X(Normal3f)                                                                                                        \
    X(NormalPointer)                                                                                                   \
    X(Vertex3f)                                                                                                        \
    X(VertexPointer)

// gl->DrawArrays(…) calls glDrawArrays(…) of the current context.
struct gl {
#define GL_FIELD(name) __typeof__(&gl##name) name;
    GL_FUNCTIONS(GL_FIELD)
    GL_OPTIONAL_FUNCTIONS(GL_FIELD)
#undef GL_FIELD
};

#endif
